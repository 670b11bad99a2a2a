// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/ros/bag_topics.h"
#include "programs/command_line.h"

namespace mivo {

/// Adds --rgb, --depth and --camera-info, which set the topics.
void declareTopics(CommandLine& line, RgbdTopics* topics);

}  // namespace mivo
