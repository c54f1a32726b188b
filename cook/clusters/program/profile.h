// What a user asks of the cluster builder: a TOML file. See cook/clusters/README.md, "Profiles".
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

/// Members of Config; nothing where the file does not set them.
struct MeshSettings
{
    std::optional<uint32_t> normal_bits;
    std::optional<float> normal_error_weight;
    std::optional<float> uv_error_weight;
    std::optional<uint32_t> influences;
};

/// For meshes whose name matches; what it does not set stays as it is for all.
struct MeshRule
{
    std::string name; ///< a pattern
    std::optional<LevelCurve> levels;
    std::vector<LevelTarget> targets;
    MeshSettings settings;
};

/// For materials whose name matches, in any mesh.
struct MaterialRule
{
    std::string name; ///< a pattern
    LevelCurve levels;
};

struct Profile
{
    LevelCurve levels{LevelStep{}};
    MeshSettings settings;
    std::vector<MeshRule> meshes;
    std::vector<MaterialRule> materials;
};

/// Read a profile. Strict: a key that is not known is an error, and so is a value out of its range.
/// errors: input_missing, profile_syntax, profile_key, profile_value; they name the line and the key.
Result<Profile> readProfile(const std::string& path);

/// The same of TOML text; `name` is what messages call it.
/// errors: profile_syntax, profile_key, profile_value.
Result<Profile> parseProfile(std::string_view text, const std::string& name);

/// What the profile says of one mesh: the first rule that matches its name, what that leaves open as for all, and for
/// each material the first rule that matches its own.
Config configOf(const Profile& profile, std::string_view mesh_name,
                std::span<const std::string> material_names);

/// Whether all of `text` matches: * stands for any characters, ? for one, everything else for itself.
bool matchesPattern(std::string_view pattern, std::string_view text);

} // namespace hearth::clusters
