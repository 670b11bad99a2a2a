// SPDX-License-Identifier: BSD-3-Clause
#include "programs/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <string>

namespace mivo {
namespace {

constexpr std::size_t kWidth = 40;  // characters
constexpr std::chrono::milliseconds kDrawPeriod{100};

}  // namespace

ProgressBar::ProgressBar(std::size_t total)
    : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::advance() {
  ++done_;
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (done_ < total_ && now - last_draw_ < kDrawPeriod) return;
  last_draw_ = now;
  draw();
}

void ProgressBar::clear() {
  if (terminal_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::draw() const {
  const std::size_t filled = total_ > 0 ? kWidth * std::min(done_, total_) / total_ : kWidth;
  std::cerr << "\r[" << std::string(filled, '#') << std::string(kWidth - filled, ' ') << "] "
            << done_ << "/" << total_ << std::flush;
}

}  // namespace mivo
