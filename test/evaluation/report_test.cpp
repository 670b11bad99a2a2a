// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mivo/core/se3.h"
#include "support/error_text.h"

namespace mivo {
namespace {

/// Straight along x at `speed` m/s while turning about x at `turn` rad/s, 10 poses a second.
Trajectory straight(double speed, double turn, int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    Vector6 twist;
    twist << speed, 0.0, 0.0, turn, 0.0, 0.0;
    trajectory.push_back({0.1 * i, expSe3(0.1 * i * twist)});
  }
  return trajectory;
}

double valueOf(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures) {
    if (figure.name == name) return figure.value;
  }
  ADD_FAILURE() << "no figure " << name;
  return std::nan("");
}

TEST(ReportTest, PosesOfAnotherTimeCoverNothing) {
  const Trajectory truth = straight(0.5, 0.2, 41);
  Trajectory estimate = straight(0.6, 0.3, 21);
  for (std::size_t i = 11; i < estimate.size(); ++i) estimate[i].stamp += 3600.0;
  EvaluationOptions options;
  options.delta = 0.5;
  const auto figures = figuresOf(evaluate(truth, estimate, options));
  EXPECT_NEAR(valueOf(figures, "coverage"), 0.25, 1e-12);
  EXPECT_NEAR(valueOf(figures, "matched"), 11.0 / 21.0, 1e-12);
}

TEST(ReportTest, FiguresOfAKnownDrift) {
  const Trajectory truth = straight(0.5, 0.2, 41);
  const Trajectory estimate = straight(0.6, 0.3, 21);
  const auto figures = figuresOf(evaluate(truth, estimate, {}));
  EXPECT_EQ(valueOf(figures, "frames"), 21.0);
  EXPECT_NEAR(valueOf(figures, "coverage"), 0.5, 1e-12);
  for (const char* name :
       {"rpe_translation_rmse_m", "rpe_translation_median_m", "rpe_translation_max_m"}) {
    EXPECT_NEAR(valueOf(figures, name), 0.1, 1e-12) << name;
  }
  for (const char* name :
       {"rpe_rotation_rmse_deg", "rpe_rotation_median_deg", "rpe_rotation_max_deg"}) {
    EXPECT_NEAR(valueOf(figures, name), 0.1 * 180.0 / M_PI, 1e-10) << name;
  }
  EXPECT_NEAR(valueOf(figures, "rpe_frame_translation_rmse_m"), 0.01, 1e-12);
  EXPECT_NEAR(valueOf(figures, "rpe_frame_rotation_rmse_deg"), 0.01 * 180.0 / M_PI, 1e-10);
  // The estimate is stretched by 0.1 m/s about its center: errors 0.1 |t - 1 s|.
  double squares = 0.0;
  for (int i = 0; i < 21; ++i) squares += std::pow(0.1 * (0.1 * i - 1.0), 2);
  EXPECT_NEAR(valueOf(figures, "ate_rmse_m"), std::sqrt(squares / 21.0), 1e-12);
  EXPECT_NEAR(valueOf(figures, "ate_max_m"), 0.1, 1e-12);
  EXPECT_EQ(valueOf(figures, "ate_pairs"), 21.0);
  EXPECT_EQ(valueOf(figures, "rpe_pairs"), 10.0);
}

TEST(ReportTest, DeltaChangesWhatIsMeasured) {
  const auto figures =
      figuresOf(evaluate(straight(0.5, 0.0, 41), straight(0.6, 0.0, 41), {0.5, 1.0, 0.02}));
  EXPECT_NEAR(valueOf(figures, "rpe_translation_rmse_m"), 0.05, 1e-12);
}

TEST(ReportTest, TextAndJson) {
  const std::vector<Figure> figures = {{"frames", 240.0}, {"ate_rmse_m", 0.0125}};
  EXPECT_EQ(toText(figures), "frames: 240\nate_rmse_m: 0.0125\n");
  EXPECT_EQ(toJson(figures), "{\n  \"frames\": 240,\n  \"ate_rmse_m\": 0.0125\n}\n");
}

TEST(ReportTest, SparseTruthGivesWhatItCan) {
  const Trajectory estimate = straight(0.6, 0.3, 41);
  const Trajectory dense = straight(0.5, 0.2, 41);
  Trajectory truth;  // at 1 Hz
  for (std::size_t i = 0; i < dense.size(); i += 10) truth.push_back(dense[i]);
  Evaluation evaluation = evaluate(truth, estimate, {});
  EXPECT_EQ(evaluation.notice, "");
  auto figures = figuresOf(evaluation);
  EXPECT_NEAR(valueOf(figures, "rpe_translation_rmse_m"), 0.1, 1e-12);
  EXPECT_EQ(valueOf(figures, "rpe_pairs"), 3.0);
  EXPECT_NEAR(valueOf(figures, "matched"), 5.0 / 41.0, 1e-12);
  EXPECT_GT(valueOf(figures, "ate_rmse_m"), 0.0);

  evaluation = evaluate(truth, estimate, {0.7, 1.0, 0.02});
  EXPECT_NE(evaluation.notice.find("The true poses are 1 s apart: choose --delta so"),
            std::string::npos)
      << evaluation.notice;
  figures = figuresOf(evaluation);
  EXPECT_EQ(valueOf(figures, "ate_pairs"), 5.0);
  for (const Figure& figure : figures) EXPECT_NE(figure.name, "rpe_translation_rmse_m");
}

TEST(ReportTest, RefusesWhatCannotBeMeasured) {
  const Trajectory truth = straight(0.5, 0.0, 41);
  const Trajectory estimate = straight(0.5, 0.0, 9);
  EXPECT_NE(errorText([&] { evaluate(truth, estimate, {}); }).find("smaller delta"),
            std::string::npos);
  EXPECT_NE(errorText([&] {
              evaluate(truth, truth, {0.001, 1.0, 0.02});
            }).find("larger delta"),
            std::string::npos);  // each pose with itself: no error at all
  EXPECT_NE(errorText([&] { evaluate(truth, {}, {}); }), "nothing thrown");
  EXPECT_NE(errorText([&] { evaluate({}, truth, {}); }), "nothing thrown");
}

}  // namespace
}  // namespace mivo
