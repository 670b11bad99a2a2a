// SPDX-License-Identifier: BSD-3-Clause
// A pixel of a keyframe turned into a point with derivatives: included after lens_formulas-inl.h,
// and as that.

namespace mivo {
namespace kernels {
namespace MIVO_FORMULAS {

struct Point3 {
  Number x, y, z;
};

MIVO_INLINE Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The ray of a pixel, of depth 1, and the derivative of pixels with respect to its x and y.
struct Ray {
  Number x, y;
  Matrix2 scale;
};

// Each of Newton's steps doubles the number of correct digits.
constexpr int kInversionSteps = 6;

/// Equidistant lens: undistorted over distorted radius.
MIVO_INLINE Number equidistantInverse(const WarpParameters& p, Number r2) {
  const Number wanted = squareRoot(r2 + constant(1e-12F));
  Number angle = wanted;
  for (int i = 0; i < kInversionSteps; ++i) {
    const Angular lens = equidistantAngle(p, angle);
    angle = angle - (angle * lens.scale - wanted) / lens.slope;
  }
  return tangent(angle) / wanted;
}

MIVO_INLINE Ray rayOf(const WarpParameters& p, Number u, Number v) {
  const Number fx = constant(p.fx);
  const Number fy = constant(p.fy);
  const Number zero = constant(0.0F);
  Ray ray = {(u - constant(p.cx)) / fx, (v - constant(p.cy)) / fy, {fx, zero, zero, fy}};
  if (p.lens == Lens::kNone) return ray;
  const Number wanted_x = ray.x;
  const Number wanted_y = ray.y;
  if (p.lens == Lens::kEquidistant) {
    const Number inverse = equidistantInverse(p, wanted_x * wanted_x + wanted_y * wanted_y);
    ray.x = wanted_x * inverse;
    ray.y = wanted_y * inverse;
  }
  for (int i = 0; p.lens != Lens::kEquidistant && i < kInversionSteps; ++i) {
    const Distorted here = distorted(p, ray.x, ray.y);
    const Matrix2& D = here.derivative;
    const Number inverse = constant(1.0F) / (D.a * D.d - D.b * D.c);
    const Number error_x = here.x - wanted_x;
    const Number error_y = here.y - wanted_y;
    ray.x = ray.x - inverse * (D.d * error_x - D.b * error_y);
    ray.y = ray.y - inverse * (D.a * error_y - D.c * error_x);
  }
  const Matrix2 D = distorted(p, ray.x, ray.y).derivative;
  ray.scale = {fx * D.a, fx * D.b, fy * D.c, fy * D.d};
  return ray;
}

/// The point of a pixel at the time the middle row was read.
MIVO_INLINE Point3 pointOn(const WarpParameters& p, const Ray& ray, Number v, Number z) {
  const Point3 X = {z * ray.x, z * ray.y, z};
  if (!p.has_row_motion) return X;
  const Number tau = v * constant(p.row_duration) + constant(p.first_row);
  const Point3 turned =
      cross({constant(p.angular[0]), constant(p.angular[1]), constant(p.angular[2])}, X);
  return {X.x - tau * (turned.x + constant(p.linear[0])),
          X.y - tau * (turned.y + constant(p.linear[1])),
          X.z - tau * (turned.z + constant(p.linear[2]))};
}

/// Derivative of a pixel with respect to the pose increment, row by row.
struct PixelMotion {
  Number u[6];
  Number v[6];
};

MIVO_INLINE void storeTwist(const Point3& X, const Point3& force, Number (&twist)[6]) {
  const Point3 turn = cross(X, force);
  twist[0] = force.x;
  twist[1] = force.y;
  twist[2] = force.z;
  twist[3] = turn.x;
  twist[4] = turn.y;
  twist[5] = turn.z;
}

/// d pixel / d increment, by the chain rule through projection and lens.
MIVO_INLINE PixelMotion pixelMotion(const Point3& X, const Matrix2& scale) {
  const Number inverse = constant(1.0F) / X.z;
  const Number px = X.x * inverse;
  const Number py = X.y * inverse;
  const Number a = inverse * scale.a;
  const Number b = inverse * scale.b;
  const Number c = inverse * scale.c;
  const Number d = inverse * scale.d;
  PixelMotion motion;
  storeTwist(X, {a, b, constant(0.0F) - (a * px + b * py)}, motion.u);
  storeTwist(X, {c, d, constant(0.0F) - (c * px + d * py)}, motion.v);
  return motion;
}

/// Second derivative of the intensity with respect to the ray: through the image and the lens.
/// @param image  with respect to the pixel
MIVO_INLINE Curvature curvatureOnRay(const WarpParameters& p, const Ray& ray, Number gu, Number gv,
                                     const Curvature& image) {
  const Matrix2& scale = ray.scale;
  const Number two = constant(2.0F);
  const Curvature through_image = {
      scale.a * scale.a * image.uu + two * scale.a * scale.c * image.uv +
          scale.c * scale.c * image.vv,
      scale.a * scale.b * image.uu + (scale.a * scale.d + scale.b * scale.c) * image.uv +
          scale.c * scale.d * image.vv,
      scale.b * scale.b * image.uu + two * scale.b * scale.d * image.uv +
          scale.d * scale.d * image.vv};
  if (p.lens == Lens::kNone) return through_image;
  const LensCurvature lens = lensCurvature(p, ray.x, ray.y);
  const Number along_x = gu * constant(p.fx);
  const Number along_y = gv * constant(p.fy);
  return {through_image.uu + along_x * lens.x.uu + along_y * lens.y.uu,
          through_image.uv + along_x * lens.x.uv + along_y * lens.y.uv,
          through_image.vv + along_x * lens.x.vv + along_y * lens.y.vv};
}

/// Upper triangle, row by row, of the second derivative of the intensity with respect to the
/// increment: through image and lens, through the projection, and the second order of the rotation.
/// @param curvature  that of curvatureOnRay()
MIVO_INLINE void secondDerivative(const Point3& X, const Matrix2& scale, Number gu, Number gv,
                                  const Curvature& curvature, Number (&second)[21]) {
  const Number half = constant(0.5F);
  const Number two = constant(2.0F);
  const Number inverse = constant(1.0F) / X.z;
  const Number square = inverse * inverse;
  const Number px = X.x * inverse;
  const Number py = X.y * inverse;
  // With respect to normalized coordinates.
  const Number nx = scale.a * gu + scale.c * gv;
  const Number ny = scale.b * gu + scale.d * gv;
  const Number xx = curvature.uu;
  const Number xy = curvature.uv;
  const Number yy = curvature.vv;
  // With respect to X: a symmetric matrix.
  const Number q00 = square * xx;
  const Number q01 = square * xy;
  const Number q11 = square * yy;
  const Number q02 = constant(0.0F) - square * (xx * px + xy * py + nx);
  const Number q12 = constant(0.0F) - square * (xy * px + yy * py + ny);
  const Number q22 =
      square * (xx * px * px + two * xy * px * py + yy * py * py + two * (nx * px + ny * py));
  // Columns of Q times d (w x X) / d w.
  const Point3 rows[3] = {{q00, q01, q02}, {q01, q11, q12}, {q02, q12, q22}};
  Point3 mixed[3];
  for (int k = 0; k < 3; ++k) mixed[k] = cross(X, rows[k]);
  const Point3 turned[3] = {cross(X, {mixed[0].x, mixed[1].x, mixed[2].x}),
                            cross(X, {mixed[0].y, mixed[1].y, mixed[2].y}),
                            cross(X, {mixed[0].z, mixed[1].z, mixed[2].z})};
  // exp(w) X = X + w x X + w x (w x X) / 2, and the gradient g is orthogonal to X.
  const Point3 g = {nx * inverse, ny * inverse, constant(0.0F) - inverse * (nx * px + ny * py)};
  second[0] = q00;
  second[1] = q01;
  second[2] = q02;
  second[6] = q11;
  second[7] = q12;
  second[11] = q22;
  const int first[3] = {3, 8, 12};
  for (int k = 0; k < 3; ++k) {
    second[first[k]] = mixed[k].x;
    second[first[k] + 1] = mixed[k].y;
    second[first[k] + 2] = mixed[k].z;
  }
  second[15] = turned[0].x + g.x * X.x;
  second[16] = turned[0].y + half * (g.x * X.y + g.y * X.x);
  second[17] = turned[0].z + half * (g.x * X.z + g.z * X.x);
  second[18] = turned[1].y + g.y * X.y;
  second[19] = turned[1].z + half * (g.y * X.z + g.z * X.y);
  second[20] = turned[2].z + g.z * X.z;
}

}  // namespace MIVO_FORMULAS
}  // namespace kernels
}  // namespace mivo
