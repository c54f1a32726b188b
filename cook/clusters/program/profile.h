// User settings of the cluster builder: a TOML profile. See cook/clusters/README.md, "Profiles".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/base/result.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::clusters
{

/// Settings for members of Config; nothing if the file does not set them.
struct MeshSettings
{
    std::optional<uint32_t> normal_bits;
    std::optional<float> normal_error_weight;
    std::optional<float> uv_error_weight;
    std::optional<uint32_t> influences;
};

/// Rule for meshes whose name matches; settings that it does not set keep the values for all meshes.
struct MeshRule
{
    std::string name; ///< a pattern
    std::optional<LevelCurve> levels;
    std::vector<LevelTarget> targets;
    MeshSettings settings;
};

/// Rule for materials whose name matches, in any mesh.
struct MaterialRule
{
    std::string name; ///< a pattern
    LevelCurve levels;
};

/// Parsed profile.
struct Profile
{
    LevelCurve levels{LevelStep{}};
    MeshSettings settings;
    std::vector<MeshRule> meshes;
    std::vector<MaterialRule> materials;
};

/// Read a profile. Strict: unknown keys and values out of range are errors. errors: input_missing,
/// profile_syntax, profile_key, profile_value, with line and key.
Result<Profile> readProfile(const std::string& path);

/// Parse a profile from TOML text; `name` is its name in messages. errors: profile_syntax, profile_key,
/// profile_value.
Result<Profile> parseProfile(std::string_view text, const std::string& name);

/// Resolve the profile for one mesh: the first rule that matches its name, for unset settings those of all
/// meshes, and for each material the first rule that matches its name.
Config resolveConfig(const Profile& profile, std::string_view mesh_name,
                     std::span<const std::string> material_names);

} // namespace hearth::clusters
