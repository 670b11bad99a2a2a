// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/mi_term.h"

#include <limits>

#include "mivo/core/parallel_chunks.h"

namespace mivo {

MiReference makeMiReference(const ReferencePoints& points, const IntensityRange& range,
                            const Parameters& parameters) {
  const Binning binning(range, parameters.mi_bins);
  MiReference reference;
  reference.bins_per_grey_level = binning.binsPerGreyLevel();
  reference.bins.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    reference.bins[i] = binning(points.intensity[i]);
  }
  if (parameters.mi_hessian == MiHessian::kReference && points.size() > 0) {
    JointHistogram histogram(parameters.mi_bins);
    for (const BinPosition& bin : reference.bins) histogram.add(bin, bin);
    histogram.normalise(points.size());
    const std::vector<float> all(points.size(), 1.0F);
    const MiDerivatives derivatives = mutualInformationDerivatives(
        points, reference, reference.bins, all, points.size(), histogram, parameters.threads);
    reference.self_hessian = -static_cast<double>(points.size()) * derivatives.hessian;
  }
  return reference;
}

MiTerm::MiTerm(const ReferencePoints& points, const MiReference& reference,
               const cv::Mat& live_image, const IntensityRange& live_range, const Warp& warp,
               const Parameters& parameters)
    : points_(points),
      reference_(reference),
      live_image_(live_image),
      warp_(warp),
      hessian_(parameters.mi_hessian),
      threads_(parameters.threads),
      live_binning_(live_range, parameters.mi_bins),
      histogram_(parameters.mi_bins) {}

double MiTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  warp_.sample(points_, T_live_ref, live_image_, nullptr, samples_);
  if (samples_.num_visible == 0) {
    mutual_information_ = 0.0;
    return std::numeric_limits<double>::infinity();
  }
  live_bins_.resize(points_.size());
  parts_.resize(numChunks(points_.size()), histogram_);
  forEachChunk(points_.size(), threads_,
               [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                 JointHistogram& part = parts_[chunk];
                 part.clear();
                 for (std::size_t i = begin; i < end; ++i) {
                   if (samples_.visible[i] == 0.0F) continue;
                   live_bins_[i] = live_binning_(samples_.value[i]);
                   part.add(reference_.bins[i], live_bins_[i]);
                 }
               });
  histogram_.clear();
  for (const JointHistogram& part : parts_) histogram_.add(part);
  histogram_.normalise(samples_.num_visible);
  mutual_information_ = histogram_.mutualInformation();
  return -static_cast<double>(points_.size()) * mutual_information_;
}

QuadraticModel MiTerm::linearise(int) {
  QuadraticModel model;
  const auto n = static_cast<double>(points_.size());
  const MiDerivatives derivatives =
      mutualInformationDerivatives(points_, reference_, live_bins_, samples_.visible,
                                   samples_.num_visible, histogram_, threads_);
  model.cost = -n * mutual_information_;
  model.gradient = -n * derivatives.gradient;
  model.hessian = hessian_ == MiHessian::kReference ? reference_.self_hessian
                                                    : Matrix6(-n * derivatives.hessian);
  return model;
}

}  // namespace mivo
