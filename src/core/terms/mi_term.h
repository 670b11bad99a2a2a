// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/execution/recycled.h"
#include "core/geometry/warp.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/cost_term.h"
#include "core/terms/joint_histogram.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Data of the keyframe for mutual information on one level, computed once (section II-E).
struct MiReference {
  std::vector<std::int32_t> bin;  ///< of each point, see BinPosition
  std::vector<float> fraction;
  std::vector<float> unclamped;  ///< 1, or 0 for an intensity outside of the range
  /// d intensity / d increment of each point in kernels::kRowFloats floats.
  std::vector<float> jacobian_rows;
  float bins_per_gray_level = 0.0F;
  /// Hessian of the cost of the keyframe aligned with itself, nats; for mi_hessian reference.
  Matrix6 self_hessian = Matrix6::Identity();

  kernels::BinsView bins(std::size_t begin = 0) const {
    return {bin.data() + begin, fraction.data() + begin};
  }
};

/// Bins of the points of a level; `range` fills them.
MiReference makeMiReference(const ReferencePoints& points, const IntensityRange& range,
                            const Parameters& parameters);
/// The same, reusing the memory of an existing one.
void makeMiReference(const ReferencePoints& points, const IntensityRange& range,
                     const Parameters& parameters, MiReference& reference);

/// Mutual information of the points' intensities in keyframe and live image (Eq. 2 to 4) as a cost:
/// minus the number of points times their mutual information.
class MiTerm : public CostTerm {
 public:
  /// Keeps references to all arguments but the range and the parameters. `points` need second
  /// derivatives. @param live_range range of gray levels of the live image.
  MiTerm(const ReferencePoints& points, const MiReference& reference, const cv::Mat& live_image,
         const IntensityRange& live_range, const Warp& warp, const Parameters& parameters);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearize(int iteration) override;
  Agreement agreement(std::size_t most_points) const override;

  double mutualInformation() const { return mutual_information_; }
  std::size_t numVisible() const { return samples_->num_visible; }

 private:
  void sample(const Eigen::Isometry3d& T_live_ref);
  kernels::BinsView liveBins(std::size_t begin = 0) const {
    return {live_bin_->data() + begin, live_fraction_->data() + begin};
  }

  const ReferencePoints& points_;
  const MiReference& reference_;
  const cv::Mat& live_image_;
  const Warp& warp_;
  MiHessian hessian_;
  int num_bins_;
  int threads_;
  Binning live_binning_;
  Eigen::Isometry3d T_live_ref_;  // of the samples
  bool is_sampled_ = false;
  Recycled<LiveSamples> samples_;
  Recycled<std::vector<std::int32_t>> live_bin_;
  Recycled<std::vector<float>> live_fraction_;
  Recycled<JointHistogram> histogram_;
  Recycled<std::vector<JointHistogram>> parts_;
  double mutual_information_ = 0.0;
};

/// Gradient and Hessian of the mutual information of n pairs of bin positions with respect to the
/// increment, in nats per pair (sections II-C and II-D), for a histogram of these pairs.
struct MiDerivatives {
  Vector6 gradient = Vector6::Zero();
  Matrix6 hessian = Matrix6::Zero();
};
MiDerivatives mutualInformationDerivatives(const ReferencePoints& points,
                                           const MiReference& reference,
                                           const kernels::BinsView& live,
                                           const std::vector<float>& visible,
                                           std::size_t num_visible, const JointHistogram& histogram,
                                           int threads);

}  // namespace mivo
