// Merges chunk META of a pack: provenance and report of all its parts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hearth::link
{

/// META texts of the parts of one source; empty if a part has none.
struct PartMetas
{
    std::string_view import_meta;
    std::string_view clusters_meta;
    std::string_view textures_meta;
};

/// Return schema "hearth.meta/1". Sources, messages and dropped features follow each other in the order of
/// the sources, counts are summed. The same parts give the same text: no dates, no paths of the machine.
/// of_pack  META texts of the parts that the pack has once
/// skipped  JSON objects for the list of what the pack lacks; META has that list only if there are some
/// texture_budget  bytes that all textures may take on the GPU, for the settings; 0: no budget
/// errors: meaning_value if a part's META or a text of `skipped` is not a JSON object; `name` is used in the
/// message.
Result<std::string> mergeMeta(std::span<const PartMetas> sources, std::span<const std::string_view> of_pack,
                              std::span<const std::string> skipped, uint64_t texture_budget,
                              const std::string& name);

/// True if the META text is that of a part of the pack, as "bricks", even if it says why there are none.
bool hasSettings(std::string_view meta, const char* part);

/// Return the name of the asset of an import part: the file name of its source without the extension; empty
/// if META has none.
std::string readAssetName(std::string_view import_meta);

} // namespace hearth::link
