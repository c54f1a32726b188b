// Lists the contents of a pack as named entries with properties, which are the units of comparing two packs.
// Nothing in an entry depends on its index in a table.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Property of an entry.
struct Property
{
    std::string name;
    std::string value;
    bool is_hash = false; ///< the value is a hash of many bytes, or the start of one
    friend bool operator==(const Property&, const Property&) = default;
};

/// Entry: one named item of a pack.
struct PackEntry
{
    std::string kind; ///< "mesh", "material", ...
    std::string name; ///< may be empty, or equal to that of other entries
    std::vector<Property> properties;
    /// Text that tells entries of the same name apart, for people: "baseColor of Bark" for a texture; else
    /// empty.
    std::string note{};
};

/// Return the entries of a checked pack. Sorted by kind: meshes, materials, textures, animations, skins,
/// instances, lights, cameras, shadow spheres, extras, specular tables and bricks, then the sources, messages
/// and dropped data of chunk META.
/// errors: those of PackView::decodePage and PackView::imageData
Result<std::vector<PackEntry>> listEntries(const formats::PackView& pack);

/// Return all other values of META, each with its JSON pointer.
std::vector<Property> readMetaSettings(const formats::PackView& pack);

} // namespace hearth::command
