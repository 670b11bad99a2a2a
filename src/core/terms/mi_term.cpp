// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/mi_term.h"

#include <limits>

#include "core/execution/parallel_chunks.h"
#include "core/terms/image_agreement.h"

namespace mivo {

namespace {

void placeInBins(const ReferencePoints& points, const Binning& binning, MiReference& reference) {
  const std::size_t n = points.size();
  reference.bin.resize(n);
  reference.fraction.resize(n);
  reference.unclamped.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const BinPosition position = binning(points.intensity[i]);
    reference.bin[i] = position.bin;
    reference.fraction[i] = position.fraction;
    reference.unclamped[i] = position.is_clamped ? 0.0F : 1.0F;
  }
}

void arrangeJacobians(const ReferencePoints& points, MiReference& reference) {
  const auto n = points.size();
  reference.jacobian_rows.assign(n * kernels::kRowFloats, 0.0F);
  for (std::size_t k = 0; k < 6; ++k) {
    const float* column = points.jacobian[k].data();
    float* entry = reference.jacobian_rows.data() + k;
    for (std::size_t i = 0; i < n; ++i, entry += kernels::kRowFloats) *entry = column[i];
  }
}

Matrix6 selfHessian(const ReferencePoints& points, const MiReference& reference,
                    const Parameters& parameters) {
  const std::vector<float> all(points.size(), 1.0F);
  JointHistogram histogram(parameters.mi.mi_bins);
  histogram.clear();
  histogram.add(reference.bins(), reference.bins(), all.data(), points.size());
  histogram.normalize(points.size());
  const MiDerivatives derivatives =
      mutualInformationDerivatives(points, reference, reference.bins(), all, points.size(),
                                   histogram, parameters.alignment.threads);
  return -static_cast<double>(points.size()) * derivatives.hessian;
}

}  // namespace

void makeMiReference(const ReferencePoints& points, const IntensityRange& range,
                     const Parameters& parameters, MiReference& reference) {
  const Binning binning(range, parameters.mi.mi_bins);
  reference.bins_per_gray_level = binning.binsPerGrayLevel();
  placeInBins(points, binning, reference);
  arrangeJacobians(points, reference);
  if (parameters.mi.mi_hessian == MiHessian::kReference && points.size() > 0) {
    reference.self_hessian = selfHessian(points, reference, parameters);
  }
}

MiReference makeMiReference(const ReferencePoints& points, const IntensityRange& range,
                            const Parameters& parameters) {
  MiReference reference;
  makeMiReference(points, range, parameters, reference);
  return reference;
}

MiTerm::MiTerm(const ReferencePoints& points, const MiReference& reference,
               const cv::Mat& live_image, const IntensityRange& live_range, const Warp& warp,
               const Parameters& parameters)
    : points_(points),
      reference_(reference),
      live_image_(live_image),
      warp_(warp),
      hessian_(parameters.mi.mi_hessian),
      num_bins_(parameters.mi.mi_bins),
      threads_(parameters.alignment.threads),
      live_binning_(live_range, parameters.mi.mi_bins) {
  histogram_->resize(parameters.mi.mi_bins);
}

double MiTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  if (!is_sampled_ || T_live_ref.matrix() != T_live_ref_.matrix()) sample(T_live_ref);
  if (samples_->num_visible == 0) return std::numeric_limits<double>::infinity();
  return -static_cast<double>(points_.size()) * mutual_information_;
}

void MiTerm::sample(const Eigen::Isometry3d& T_live_ref) {
  T_live_ref_ = T_live_ref;
  is_sampled_ = true;
  warp_.sample(points_, points_.size(), T_live_ref, live_image_, *samples_);
  live_bin_->resize(points_.size());
  live_fraction_->resize(points_.size());
  kernels::active().binPositions(samples_->value.data(), points_.size(), live_binning_.low(),
                                 live_binning_.binsPerGrayLevel(), live_binning_.top(),
                                 live_bin_->data(), live_fraction_->data());
  const std::size_t chunks = numChunks(points_.size());
  if (parts_->size() < chunks) parts_->resize(chunks);
  forEachChunk(points_.size(), threads_,
               [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                 JointHistogram& part = (*parts_)[chunk];
                 part.resize(num_bins_);
                 part.clear();
                 part.add(reference_.bins(begin), liveBins(begin), samples_->visible.data() + begin,
                          end - begin);
               });
  histogram_->clear();
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) histogram_->add((*parts_)[chunk]);
  histogram_->normalize(samples_->num_visible);
  mutual_information_ = histogram_->mutualInformation();
}

QuadraticModel MiTerm::linearize(int) {
  QuadraticModel model;
  const auto n = static_cast<double>(points_.size());
  const MiDerivatives derivatives =
      mutualInformationDerivatives(points_, reference_, liveBins(), samples_->visible,
                                   samples_->num_visible, *histogram_, threads_);
  model.cost = -n * mutual_information_;
  model.gradient = -n * derivatives.gradient;
  model.hessian = hessian_ == MiHessian::kReference ? reference_.self_hessian
                                                    : Matrix6(-n * derivatives.hessian);
  return model;
}

Agreement MiTerm::agreement(std::size_t most_points) const {
  return imageAgreement(points_, {live_image_, nullptr}, *samples_, samples_->visible, warp_,
                        T_live_ref_, most_points);
}

}  // namespace mivo
