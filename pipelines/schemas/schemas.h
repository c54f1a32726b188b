// JSON Schemas of Hearth's output formats: the files hearth.NAME.VERSION.json of this folder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <span>
#include <string_view>

namespace hearth::schemas
{

struct Schema
{
    std::string_view name; ///< "plan" of hearth.plan/1
    std::string_view text; ///< JSON Schema, draft 2020-12
};

/// Return all schemas, in order of their names.
std::span<const Schema> all();

} // namespace hearth::schemas
