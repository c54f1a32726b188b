// Holds JSON against a schema, as far as Hearth's schemas go: type, enum, const, required, properties, additionalProperties,
// items, minimum, pattern, allOf and references into $defs. Slow and obvious.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hearth::test
{

/// The first difference, as "/assets/0/state: ..."; empty where there is none. A keyword that is not known is one.
std::string faultOfSchema(const std::string& schema_file, const nlohmann::json& value);

} // namespace hearth::test
