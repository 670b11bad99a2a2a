// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace mivo {

// What the parameters of parameters.def that are words may be; their texts stand there. The
// enumerators are in the order of those words.

enum class Method { kSsd, kMi, kHybrid };
enum class PhotometricModel { kNone, kLcn };
enum class MiHessian { kFull, kReference };
enum class RobustWeight { kNone, kHuber, kTukey, kStudentT };
enum class KeyframePolicy { kAutomatic, kFirst };
enum class MotionModelKind { kConstantVelocity, kConstantPose };

}  // namespace mivo
