// What a pack holds, as things with a name and facts: what two packs are compared by. Nothing in it depends on where a thing
// stands in a table.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>
#include <vector>

namespace hearth::command
{

struct Fact
{
    std::string what;
    std::string value;
    bool is_hash = false; ///< the value is the hash of many bytes, or its start: it tells contents apart
    friend bool operator==(const Fact&, const Fact&) = default;
};

struct Thing
{
    std::string kind; ///< "mesh", "material", ...
    std::string name; ///< may be empty, and that of others as well
    std::vector<Fact> facts;
    /// What tells those of one name apart, for people: of a texture "baseColor of Bark"; else empty.
    std::string note{};
};

/// Of a pack that has been checked. Sorted by kind: meshes, materials, textures, animations, skins, instances, lights,
/// cameras, shadow spheres, what light is taken from, and what META says of sources and of what was lost.
/// errors: those of PackView::decodePage and PackView::imageData
Result<std::vector<Thing>> thingsOf(const formats::PackView& pack);

/// What else META says, number by number: JSON pointer and value.
std::vector<Fact> settingsOf(const formats::PackView& pack);

} // namespace hearth::command
