// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "programs/command_line.h"
#include "ros/bag_topics.h"

namespace mivo {

/// Adds --rgb, --depth and --camera-info, which set the topics.
void declareTopics(CommandLine& line, RgbdTopics* topics);

}  // namespace mivo
