// Validates JSON against a schema with the keywords that Hearth's schemas use: type, enum, const, required,
// properties, additionalProperties, items, minItems and maxItems, minimum, exclusiveMinimum and maximum,
// minLength and pattern, allOf, oneOf, if, then and else, and references into $defs. Slow and obvious.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/json/json.h"

#include <string>

namespace hearth::test
{

/// Return the first violation, as "/assets/0/state: ..."; empty if there is none. An unknown keyword is a
/// violation.
std::string findFault(const Json& schema, const Json& value);
/// Validate against a schema in a file.
std::string faultOfSchema(const std::string& schema_file, const Json& value);

} // namespace hearth::test
