// Chunk META of a pack: provenance and report of all its parts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <span>
#include <string>
#include <string_view>

namespace hearth::link
{

/// The META texts of the parts of one source; empty where a part has none.
struct PartMetas
{
    std::string_view import_meta;
    std::string_view clusters_meta;
    std::string_view textures_meta;
};

/// Schema "hearth.meta/1". Sources, messages and what was dropped follow each other in the order of the sources,
/// counts are added up. The same parts give the same text: no dates, no paths of the machine.
/// errors: meaning_value where a part's META is not an object of JSON; `name` stands in the message.
Result<std::string> mergedMeta(std::span<const PartMetas> sources, const std::string& name);

/// Returns what the asset of an import part is called: the file name of its source without the extension; empty where META
/// does not say.
std::string assetNameOf(std::string_view import_meta);

} // namespace hearth::link
