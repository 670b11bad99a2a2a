// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mivo {

enum class Method { kSsd, kMi, kHybrid };
enum class PhotometricModel { kNone, kLcn };
enum class MiHessian { kFull, kReference };
enum class RobustWeight { kNone, kHuber, kTukey, kStudentT };
enum class KeyframePolicy { kAutomatic, kFirst };
enum class Prediction { kConstantVelocity, kConstantPose };

/// When a changed parameter acts: with the next frame, or with the next keyframe (made at once).
enum class Update { kLive, kKeyframe };

/// Every constant of the method, with the defaults of parameters.def. Units and ranges stand there.
struct Parameters {
#define MIVO_GROUP(title)
#define MIVO_INT(name, value, minimum, maximum, unit, update, text) int name = value;
#define MIVO_DOUBLE(name, value, minimum, maximum, unit, update, text) double name = value;
#define MIVO_BOOL(name, value, update, text) bool name = value;
#define MIVO_ENUM(Type, name, value, words, update, text) Type name = Type::value;
#include "mivo/core/parameters.def"
#undef MIVO_GROUP
#undef MIVO_INT
#undef MIVO_DOUBLE
#undef MIVO_BOOL
#undef MIVO_ENUM

  /// Throws Error when a value is out of its range or not finite, naming it and the range.
  void validate() const;
};

/// One row of parameters.def, for those who read, print and document parameters.
struct ParameterInfo {
  enum class Type { kInt, kDouble, kBool, kEnum };
  std::string group;
  std::string name;
  Type type;
  std::string default_value;
  double minimum;                  ///< numbers only
  double maximum;                  ///< numbers only
  std::vector<std::string> words;  ///< enumerations only
  std::string unit;                ///< empty for switches and enumerations
  Update update;
  std::string text;
};

/// All parameters in the order of the table.
const std::vector<ParameterInfo>& parameterTable();

/// Sets one parameter from its text. Throws Error for an unknown name (with the nearest known one),
/// a wrong type, or a value out of range (with the range); parameters are unchanged then.
void setParameter(Parameters& parameters, const std::string& name, const std::string& value);

/// The value as text that setParameter reads back exactly. Throws Error for an unknown name.
std::string getParameter(const Parameters& parameters, const std::string& name);

/// Whether going from one set to the other needs a new keyframe.
bool needsNewKeyframe(const Parameters& before, const Parameters& after);

}  // namespace mivo
