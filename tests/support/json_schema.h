// Holds JSON against a schema, as far as Hearth's schemas go: type, enum, const, required, properties, additionalProperties,
// items, minItems and maxItems, minimum, exclusiveMinimum and maximum, minLength and pattern, allOf, oneOf, if, then and else,
// and references into $defs. Slow and obvious.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/json/json.h"

#include <string>

namespace hearth::test
{

/// The first difference, as "/assets/0/state: ..."; empty where there is none. A keyword that is not known is one.
std::string faultOf(const Json& schema, const Json& value);
/// The same with a schema in a file.
std::string faultOfSchema(const std::string& schema_file, const Json& value);

} // namespace hearth::test
