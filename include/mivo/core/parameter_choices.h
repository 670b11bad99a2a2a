// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace mivo {

// The enumerations of parameters.def, in the order of their words there.

enum class Method { kSsd, kMi, kHybrid };
enum class PhotometricModel { kNone, kLcn };
enum class MiHessian { kFull, kReference };
enum class RobustWeight { kNone, kHuber, kTukey, kStudentT };
enum class KeyframePolicy { kAutomatic, kFirst };
enum class MotionModelKind { kConstantVelocity, kConstantPose, kFilteredVelocity };

}  // namespace mivo
