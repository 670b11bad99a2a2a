// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_options.h"

#include "mivo/core/error.h"

namespace mivo {

namespace po = boost::program_options;

void ParameterOptions::declare(CommandLine& line) {
  line.options()("set", po::value(&settings_)->composing()->value_name("name=value"),
                 "set one parameter; may be given several times");
}

Parameters ParameterOptions::parameters() const {
  Parameters parameters;
  try {
    for (const std::string& setting : settings_) {
      const std::size_t equals = setting.find('=');
      if (equals == std::string::npos) {
        throw UsageError("--set " + setting + " is not of the form name=value");
      }
      setParameter(parameters, setting.substr(0, equals), setting.substr(equals + 1));
    }
    parameters.validate();
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  return parameters;
}

}  // namespace mivo
