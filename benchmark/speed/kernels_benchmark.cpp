// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <functional>
#include <limits>
#include <string>

#include "kernel_inputs.h"

// Each kernel, or the few that a step of the tracker runs one after the other, with every backend
// that this processor has: name/backend. Items are points or pixels.

namespace {

using mivo::KernelInputs;
using mivo::kernels::Kernels;

constexpr std::size_t kPoints = 4800;
constexpr std::size_t kGeometricPoints = 1500;

using Body = std::function<void(const Kernels&)>;

void add(const std::string& name, const mivo::kernels::Backend& backend, std::size_t items,
         const Body& body) {
  const Kernels* kernels = backend.kernels;
  benchmark::RegisterBenchmark(
      (name + "/" + backend.name).c_str(), [kernels, items, body](benchmark::State& state) {
        for (auto step : state) {
          (void)step;
          body(*kernels);
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
      });
}

void addWarps(KernelInputs& in, const mivo::kernels::Backend& backend) {
  add("warp_and_interpolation", backend, in.size, [&in](const Kernels& k) {
    k.warpPoints(in.warp, in.points(), in.size, in.u.data(), in.v.data(), in.visible.data());
    k.sampleIntensity(in.image(), in.u.data(), in.v.data(), in.visible.data(), in.size,
                      in.value.data());
  });
  add("warp_and_normalized_interpolation", backend, in.size, [&in](const Kernels& k) {
    k.warpPoints(in.warp, in.points(), in.size, in.u.data(), in.v.data(), in.visible.data());
    k.sampleNormalized(in.image(), in.contrast(), std::numeric_limits<float>::infinity(),
                       in.u.data(), in.v.data(), in.visible.data(), in.size, in.value.data());
  });
}

void addSums(KernelInputs& in, const mivo::kernels::Backend& backend) {
  add("accumulation", backend, in.size, [&in](const Kernels& k) {
    mivo::kernels::LeastSquaresSums sums{};
    const auto jacobians = in.jacobians();
    k.accumulateLeastSquares(mivo::RobustWeight::kHuber, 4.0F, in.residual.data(), in.ones.data(),
                             jacobians.data(), in.size, sums);
    benchmark::DoNotOptimize(sums);
  });
  add("robust_cost", backend, in.size, [&in](const Kernels& k) {
    benchmark::DoNotOptimize(k.robustCost(mivo::RobustWeight::kHuber, 4.0F, in.residual.data(),
                                          in.ones.data(), in.size));
  });
  add("geometric_residuals", backend, kGeometricPoints, [&in](const Kernels& k) {
    const mivo::kernels::PlanesView planes{
        in.points(), {in.nx.data(), in.ny.data(), in.nz.data()}, in.weight.data()};
    const mivo::kernels::DepthView depth{nullptr, in.depth.data(), KernelInputs::kWidth, 0.001F};
    mivo::kernels::Motion back{};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) back.rotation[3 * r + c] = in.warp.rotation[3 * c + r];
    }
    float* columns[6];
    static std::vector<float> jacobian(6 * kPoints);
    for (std::size_t c = 0; c < 6; ++c) columns[c] = jacobian.data() + c * kPoints;
    k.warpPoints(in.warp, in.points(), kGeometricPoints, in.u.data(), in.v.data(),
                 in.visible.data());
    k.geometricResiduals(in.warp, back, planes, depth, in.u.data(), in.v.data(), kGeometricPoints,
                         in.visible.data(), in.value.data(), columns);
  });
}

void addInformation(KernelInputs& in, const mivo::kernels::Backend& backend) {
  add("histogram", backend, in.size, [&in](const Kernels& k) {
    static std::vector<float> scratch(mivo::kernels::histogramScratch(KernelInputs::kSide));
    double sums[KernelInputs::kSide * KernelInputs::kSide] = {};
    k.jointHistogram(in.referenceBins(), in.liveBins(), in.ones.data(), in.size,
                     KernelInputs::kSide, scratch.data(), sums);
    benchmark::DoNotOptimize(sums);
  });
  add("mi_gradient_and_hessian", backend, in.size, [&in](const Kernels& k) {
    const auto jacobians = in.jacobians();
    const float* second[21];
    for (std::size_t i = 0; i < 21; ++i) second[i] = in.second_derivative[i].data();
    alignas(
        64) float rows[KernelInputs::kSide * KernelInputs::kSide * mivo::kernels::kRowFloats] = {};
    mivo::kernels::MiSums sums{};
    k.miDerivatives(in.referenceBins(), in.liveBins(), in.ones.data(), in.jacobian_rows.data(),
                    jacobians.data(), second, in.size, KernelInputs::kSide, 7.0F / 200.0F,
                    in.log_ratio.data(), rows, sums);
    benchmark::DoNotOptimize(sums);
  });
}

void addKeyframes(KernelInputs& in, const mivo::kernels::Backend& backend) {
  add("keyframe_points", backend, in.size, [&in](const Kernels& k) {
    static std::vector<float> results(30 * kPoints);
    mivo::kernels::DerivedPoints out{};
    float* next = results.data();
    for (float** array : {&out.x, &out.y, &out.z}) {
      *array = next;
      next += kPoints;
    }
    for (float*& array : out.jacobian) {
      array = next;
      next += kPoints;
    }
    double motion[21] = {};
    k.keyframePoints(in.warp,
                     {in.u.data(), in.v.data(), in.z.data(), in.residual.data(),
                      in.intensity.data(), nullptr, nullptr, nullptr},
                     in.size, out, motion);
    benchmark::DoNotOptimize(motion);
  });
  constexpr auto kPixels = static_cast<std::size_t>(KernelInputs::kWidth * KernelInputs::kHeight);
  add("gradient_and_maxima", backend, kPixels, [&in](const Kernels& k) {
    static std::vector<float> rows(3 * KernelInputs::kWidth);
    static std::vector<std::uint8_t> marks(KernelInputs::kWidth);
    const auto rowOf = [&](int y) { return rows.data() + y % 3 * KernelInputs::kWidth; };
    for (int y = 1; y + 1 < KernelInputs::kHeight; ++y) {
      k.gradientRow(in.image(), y, rowOf(y));
      if (y < 3) continue;
      const float* const around[3] = {rowOf(y - 2), rowOf(y - 1), rowOf(y)};
      k.maximaRow(in.image(), y - 1, around, 1.0F, marks.data());
    }
  });
  add("pyramid_level", backend, kPixels, [&in](const Kernels& k) {
    static std::vector<float> coarse(KernelInputs::kWidth * KernelInputs::kHeight / 4);
    static std::vector<float> scratch(mivo::kernels::imageScratch(KernelInputs::kWidth));
    k.reduce(in.image(), coarse.data(), KernelInputs::kWidth / 2, scratch.data());
  });
}

}  // namespace

int main(int argc, char** argv) {
  KernelInputs inputs(kPoints);
  for (const mivo::kernels::Backend& backend : mivo::kernels::backends()) {
    addWarps(inputs, backend);
    addSums(inputs, backend);
    addInformation(inputs, backend);
    addKeyframes(inputs, backend);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
