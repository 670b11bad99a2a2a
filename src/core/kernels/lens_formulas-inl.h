// SPDX-License-Identifier: BSD-3-Clause
// What a lens does to normalized coordinates, with its derivatives: included once for floats and
// once for the vectors of each instruction set, and therefore without include guards. Before it
// MIVO_FORMULAS names a namespace that has a type Number with + - * /, constant(float),
// squareRoot(), arcTangent() and tangent(), and MIVO_INLINE says how to inline.

namespace mivo {
namespace kernels {
namespace MIVO_FORMULAS {

/// A 2 x 2 matrix, row by row.
struct Matrix2 {
  Number a, b, c, d;
};

/// A symmetric 2 x 2 matrix of second derivatives: d2/du2, d2/du dv, d2/dv2.
struct Curvature {
  Number uu, uv, vv;
};

/// Normalized coordinates behind a lens, and their derivative.
struct Distorted {
  Number x, y;
  Matrix2 derivative;
};

/// A lens without its tangential part: a point is multiplied by `scale`, whose derivative with
/// respect to the point is `slope` times the point, whose own is `curvature` times the point.
struct Radial {
  Number scale, slope, curvature;
};

/// 1 + a r^2 + b r^4 + c r^6.
MIVO_INLINE Radial polynomial(float a, float b, float c, Number r2) {
  const Number k1 = constant(a);
  const Number k2 = constant(b);
  const Number k3 = constant(c);
  const Number two = constant(2.0F);
  return {constant(1.0F) + r2 * (k1 + r2 * (k2 + r2 * k3)),
          two * (k1 + r2 * (two * k2 + r2 * constant(3.0F) * k3)),
          constant(8.0F) * (k2 + r2 * constant(3.0F) * k3)};
}

MIVO_INLINE Radial plumbBob(const WarpParameters& p, Number r2) {
  return polynomial(p.k1, p.k2, p.k3, r2);
}

MIVO_INLINE Radial rational(const WarpParameters& p, Number r2) {
  const Radial over = plumbBob(p, r2);
  const Radial under = polynomial(p.k4, p.k5, p.k6, r2);
  const Number scale = over.scale / under.scale;
  const Number slope = (over.slope - scale * under.slope) / under.scale;
  return {scale, slope,
          (over.curvature - constant(2.0F) * slope * under.slope - scale * under.curvature) /
              under.scale};
}

/// Of an angle to the optical axis: distorted radius over the angle, the derivative of the
/// distorted radius, and its second derivative.
struct Angular {
  Number scale, slope, curvature;
};

MIVO_INLINE Angular equidistantAngle(const WarpParameters& p, Number angle) {
  const Number k1 = constant(p.k1);
  const Number k2 = constant(p.k2);
  const Number k3 = constant(p.k3);
  const Number k4 = constant(p.k4);
  const Number a2 = angle * angle;
  return {
      constant(1.0F) + a2 * (k1 + a2 * (k2 + a2 * (k3 + a2 * k4))),
      constant(1.0F) +
          a2 * (constant(3.0F) * k1 +
                a2 * (constant(5.0F) * k2 + a2 * (constant(7.0F) * k3 + a2 * constant(9.0F) * k4))),
      angle *
          (constant(6.0F) * k1 +
           a2 * (constant(20.0F) * k2 + a2 * (constant(42.0F) * k3 + a2 * constant(72.0F) * k4)))};
}

MIVO_INLINE Radial equidistant(const WarpParameters& p, Number r2) {
  // On the axis, where all is 0 / 0, and too small to matter elsewhere.
  const Number square = r2 + constant(1e-12F);
  const Number r = squareRoot(square);
  const Number angle = arcTangent(r);
  const Angular lens = equidistantAngle(p, angle);
  const Number scale = angle * lens.scale / r;
  // Derivatives of the distorted radius with respect to r.
  const Number turn = constant(1.0F) / (constant(1.0F) + square);
  const Number first = lens.slope * turn;
  const Number second = (lens.curvature * turn - constant(2.0F) * r * first) * turn;
  const Number slope = (first - scale) / square;
  return {scale, slope, (second / r - constant(3.0F) * slope) / square};
}

MIVO_INLINE Radial radialOf(const WarpParameters& p, Number r2) {
  if (p.lens == Lens::kEquidistant) return equidistant(p, r2);
  return p.lens == Lens::kRational ? rational(p, r2) : plumbBob(p, r2);
}

MIVO_INLINE Distorted distorted(const WarpParameters& p, Number x, Number y) {
  const Number p1 = constant(p.p1);
  const Number p2 = constant(p.p2);
  const Number two = constant(2.0F);
  const Number r2 = x * x + y * y;
  const Radial lens = radialOf(p, r2);
  const Number radial = lens.scale;
  const Number slope = lens.slope;
  const Number mixed = slope * x * y + two * (p1 * x + p2 * y);
  return {x * radial + two * p1 * x * y + p2 * (r2 + two * x * x),
          y * radial + p1 * (r2 + two * y * y) + two * p2 * x * y,
          {radial + slope * x * x + two * p1 * y + constant(6.0F) * p2 * x, mixed, mixed,
           radial + slope * y * y + constant(6.0F) * p1 * y + two * p2 * x}};
}

/// Normalized coordinates, or a difference of them.
struct NormalizedPoint {
  Number x, y;
};

/// How far a ray is moved by a distance behind the lens of less than a pixel.
MIVO_INLINE NormalizedPoint beforeLens(const WarpParameters& p, const NormalizedPoint& ray,
                                       const NormalizedPoint& distance) {
  if (p.lens == Lens::kNone) return distance;
  const Matrix2 D = distorted(p, ray.x, ray.y).derivative;
  const Number inverse = constant(1.0F) / (D.a * D.d - D.b * D.c);
  return {inverse * (D.d * distance.x - D.b * distance.y),
          inverse * (D.a * distance.y - D.c * distance.x)};
}

/// Second derivatives of both normalized coordinates behind a lens.
struct LensCurvature {
  Curvature x, y;
};

MIVO_INLINE LensCurvature lensCurvature(const WarpParameters& p, Number x, Number y) {
  const Number two = constant(2.0F);
  const Number three = constant(3.0F);
  const Number p1 = two * constant(p.p1);
  const Number p2 = two * constant(p.p2);
  const Radial lens = radialOf(p, x * x + y * y);
  const Number along_x = lens.slope * x;
  const Number along_y = lens.slope * y;
  const Number xx = lens.curvature * x * x;
  const Number yy = lens.curvature * y * y;
  const Number mixed_x = along_x + yy * x + p2;  // d2x/dy2 = d2y/dx dy
  const Number mixed_y = along_y + xx * y + p1;  // d2y/dx2 = d2x/dx dy
  return {{three * along_x + xx * x + three * p2, mixed_y, mixed_x},
          {mixed_y, mixed_x, three * along_y + yy * y + three * p1}};
}

}  // namespace MIVO_FORMULAS
}  // namespace kernels
}  // namespace mivo
