// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mivo/core/parameter_choices.h"

namespace mivo {

/// When a change takes effect: with the next frame, or with the next keyframe, which is created
/// from the next frame.
enum class Update { kLive, kKeyframe };

// One struct for each group of parameters.def, with the defaults of its rows: AlignmentParameters,
// DepthParameters, ... Units, ranges and texts are there. Each stage of the tracker takes only the
// groups it needs.
#define MIVO_GROUP(Struct, member, title) struct Struct {
#define MIVO_GROUP_END(Struct, member) \
  }                                    \
  ;
#define MIVO_INT(name, value, minimum, maximum, unit, update, text) int name = value;
#define MIVO_DOUBLE(name, value, minimum, maximum, unit, update, text) double name = value;
#define MIVO_BOOL(name, value, update, text) bool name = value;
#define MIVO_ENUM(Type, name, value, words, update, text) Type name = Type::value;
#include "mivo/core/parameters.def"
#undef MIVO_GROUP
#undef MIVO_GROUP_END
#undef MIVO_INT
#undef MIVO_DOUBLE
#undef MIVO_BOOL
#undef MIVO_ENUM

/// All parameters, by group.
struct Parameters {
#define MIVO_GROUP(Struct, member, title) Struct member;
#define MIVO_GROUP_END(Struct, member)
#define MIVO_INT(name, value, minimum, maximum, unit, update, text)
#define MIVO_DOUBLE(name, value, minimum, maximum, unit, update, text)
#define MIVO_BOOL(name, value, update, text)
#define MIVO_ENUM(Type, name, value, words, update, text)
#include "mivo/core/parameters.def"
#undef MIVO_GROUP
#undef MIVO_GROUP_END
#undef MIVO_INT
#undef MIVO_DOUBLE
#undef MIVO_BOOL
#undef MIVO_ENUM

  /// Throws Error when a value is out of its range or not finite, naming it and the range.
  void validate() const;
};

/// One row of parameters.def, for reading, printing and documenting parameters.
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

/// Whether a parameter that takes effect with a keyframe differs, so that existing keyframes are
/// unusable.
bool actWithKeyframe(const Parameters& before, const Parameters& after);

/// `before` with the live parameters of `after`.
Parameters withLiveParameters(const Parameters& before, const Parameters& after);

}  // namespace mivo
