// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/cost_term.h"
#include "mivo/core/parameters.h"
#include "mivo/core/reference_points.h"
#include "mivo/core/warp.h"

namespace mivo {

/// Robust sum of squared differences (Eq. 1), inverse compositional Gauss-Newton: residual
/// r = I_live(w(x)) - I_ref(x), in grey levels, of the scale that the residuals themselves show.
class SsdTerm : public CostTerm {
 public:
  /// Keeps references to all arguments but the parameters.
  SsdTerm(const ReferencePoints& points, const cv::Mat& live_image, const Warp& warp,
          const Parameters& parameters);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearise(int iteration) override;

  /// Robust standard deviation of the residuals, grey levels; 0 before the first linearise().
  double scale() const { return scale_; }
  std::size_t numVisible() const { return samples_.num_visible; }

 private:
  double estimateScale();
  double cost() const;

  const ReferencePoints& points_;
  const cv::Mat& live_image_;
  const Warp& warp_;
  RobustWeight weight_;
  int scale_iterations_;
  double min_scale_;
  int threads_;
  LiveSamples samples_;
  std::vector<float> magnitudes_;
  double scale_ = 0.0;
};

}  // namespace mivo
