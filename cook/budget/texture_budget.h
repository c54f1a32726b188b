// Shares a budget of bytes among the textures of all sources of a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/budget/budget.h"
#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::budget
{

/// Formats that an image may have.
struct TextureFormats
{
    std::string content;              ///< images with equal contents are stored once
    std::vector<std::string> names{}; ///< at least one
    BudgetOptions options{};          ///< [names.size()]
};

/// Images of a source, in their order.
using SourceTextures = std::vector<TextureFormats>;

/// Parse what hearth-estimates has written. errors: json_syntax
Result<SourceTextures> parseEstimates(const std::string& text, const std::string& file);

struct TextureShare
{
    std::vector<std::vector<std::string>> formats{}; ///< [sources][images] name of the format of each
    size_t texture_count = 0; ///< number of textures in the pack: equal ones count once
    uint64_t budget = 0;
    uint64_t bytes = 0;     ///< of all textures of the pack
    uint64_t min_bytes = 0; ///< of all in their smallest formats
    uint64_t max_bytes = 0; ///< of all in formats beside which more bytes gain nothing
    bool is_held = true;    ///< bytes are within the budget
};

/// Choose formats as shareBudget does. Images of equal content and equal formats are one texture, and get the
/// same one.
TextureShare shareTextures(std::span<const SourceTextures> sources, uint64_t budget);

/// Return the list that completes the actions of sources: a line for each, with "IMAGE=FORMAT" for each
/// image.
std::string listText(const TextureShare& share);

/// Return JSON text with the schema "hearth.budget/1".
std::string shareJson(const TextureShare& share);

} // namespace hearth::budget
