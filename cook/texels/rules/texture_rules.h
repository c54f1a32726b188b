// Rules for textures: targets and formats by role or by name, in place of those of all textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/rules/families.h"
#include "formats/base/result.h"
#include "formats/records/scene.h"
#include "formats/records/texel_format.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::texels
{

/// Name of a format that stands for the one without compression.
inline constexpr std::string_view kPlainFormat = "plain";

/// Settings that a rule sets, or that hold for an image.
struct TextureChoice
{
    std::optional<Effort> quality{};
    /// in the unit of the role (imageErrorUnit): decibels, degrees or stops
    std::optional<double> target{};
    std::optional<Families> families{};
    std::string format{}; ///< as matchesFormat; empty: the search chooses
};

struct RoleRule
{
    formats::ImageRole role = formats::ImageRole::none;
    TextureChoice choice{};
};

struct NameRule
{
    std::string name;   ///< a pattern, as matchesPattern
    std::string path{}; ///< pattern of sources, which hearth replaces before it starts a cooker; empty: any
    TextureChoice choice{};
};

struct TextureRules
{
    std::vector<RoleRule> roles{};
    std::vector<NameRule> images{};
};

/// Parse rules from lines of TOML: "textures.role=[...]" and "textures.image=[...]", the settings of those
/// names. `file` is the name in messages.
/// errors: profile_syntax, profile_key, profile_value
Result<TextureRules> parseTextureRules(std::string_view text, const std::string& file);

/// Resolve the rules for one image: the first rule whose pattern matches its name, over the first rule of its
/// role, over `all`. What a rule sets replaces less specific settings that contradict it: a target or a
/// quality replaces a format, a format a target, families a format.
TextureChoice resolveChoice(const TextureRules& rules, const TextureChoice& all, formats::ImageRole role,
                            std::string_view name);

/// True if a rule names this format: by all of its name, "astc-6x6-srgb", without what its numbers mean,
/// "astc-6x6", or, if it has no compression, by kPlainFormat.
bool matchesFormat(std::string_view rule, const formats::TexelFormatTraits& format);

} // namespace hearth::texels
