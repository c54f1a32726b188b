// Chunk of the custom properties of a source's objects ("extras" in glTF). See FORMAT.md, "Extras".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <array>

namespace hearth::formats
{

inline constexpr uint32_t kChunkExtras = fourCC("EXTR"); ///< ExtrasRecord[]

/// Kind of object that has extras. The last three are of a source as a whole.
enum class ExtrasOwner : uint32_t
{
    node = 0,
    mesh = 1,
    material = 2,
    camera = 3,
    light = 4,
    skin = 5,
    animation = 6,
    asset = 7, ///< the object "asset" of glTF, with the author and the licence
    scene = 8, ///< the scene that is drawn
    file = 9,  ///< the whole document
};

/// Name of each ExtrasOwner, for people and scripts.
inline constexpr std::array<std::string_view, 10> kExtrasOwnerNames{
    "node", "mesh", "material", "camera", "light", "skin", "animation", "asset", "scene", "file"};

/// Extras of an object. Sorted by owner, then index; no object appears twice.
struct ExtrasRecord
{
    uint32_t owner;
    uint32_t index;
    StringRef json;
};

/// Maximum bytes of an object's extras, far more than people type, and little enough for a game to parse.
inline constexpr uint32_t kMaxExtrasBytes = 1u << 24;

/// Maximum nesting of arrays and objects in extras, so that a recursive parser is safe.
inline constexpr uint32_t kMaxExtrasDepth = 128;

/// Return a number that sorts extras as the chunk is sorted.
constexpr uint64_t makeExtrasKey(uint32_t owner, uint32_t index)
{
    return uint64_t{owner} << 32 | index;
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::ExtrasRecord, 16,
              HEARTH_FIELD(hearth::formats::ExtrasRecord, owner, "kind of object: ExtrasOwner"),
              HEARTH_FIELD(hearth::formats::ExtrasRecord, index,
                           "of the object in the table of its kind; asset, scene and file: chunk ASST"),
              HEARTH_FIELD(hearth::formats::ExtrasRecord, json, "JSON text, not empty"));
