// Lights that a pixel evaluates: those that every point gets, then the ranged ones of its list. Needs
// light_block.glsl and `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_bits.h"
#include "formats/gpu_shared/specialization.h"

layout(constant_id = kConstantLightList) const uint kLightList = kLightListCells;

struct LightListing
{
    uint unranged_count;
    uint count; // of all lights
    uint first_word; // of the indices
    bool has_indices; // false: the ranged lights are all of the frame's
};

// Word of the list of a point, as in findLights.
uint listWord(vec3 position, vec2 pixel, uint slot)
{
    if (kLightList == kLightListSlots && slot >= lighting.list_count)
        return lightCellWord(0u, kAllLights);
    uint number = slot;
    if (kLightList == kLightListTiles)
        number = lightCellAt(lighting.tiles, pixel.x, pixel.y, 0.0);
    if (kLightList == kLightListCells || kLightList == kLightListBits)
    {
        float depth = dot(view.clip_w.xyz, position);
        number = lightCellAt(lighting.cascades[lightCascadeAt(depth)], pixel.x, pixel.y, depth);
    }
    return light_words[lighting.first_cell_word + number];
}

// position  relative to the eye
// slot      of the visible list
LightListing findLights(vec3 position, vec2 pixel, uint slot)
{
    uint unranged_count = light_words[lighting.first_list_word + kCountUnranged];
    uint ranged = light_words[lighting.first_list_word + kCountRanged];
    LightListing listing = LightListing(unranged_count, unranged_count + ranged, 0u, false);
    const bool has_no_list =
        kLightList == kLightListVolumes || (kLightList == kLightListBits && ranged <= kMarkedLights);
    if (has_no_list)
        listing.count = unranged_count;
    if (has_no_list || kLightList == kLightListFrame || ranged == 0u)
        return listing;
    uint word = listWord(position, pixel, slot);
    uint count = lightCellCount(word);
    listing.has_indices = count != kAllLights;
    if (listing.has_indices)
    {
        listing.count = unranged_count + count;
        listing.first_word = lighting.first_index_word + lightCellOffset(word);
    }
    return listing;
}

// Row of a light of the frame's list.
uint frameLight(uint place) { return light_words[lighting.first_list_word + kLightCountWords + place]; }

// Place in the frame's list of light `number` of a listing.
uint listedPlace(LightListing listing, uint number)
{
    uint place = number;
    if (listing.has_indices && number >= listing.unranged_count)
    {
        uint in_list = number - listing.unranged_count;
        uint pair = light_words[listing.first_word + (in_list >> 1)];
        place = listing.unranged_count + ((in_list & 1u) == 0u ? pair & 0xFFFFu : pair >> 16);
    }
    return place;
}

// Row of light `number` of a listing.
uint listedLight(LightListing listing, uint number) { return frameLight(listedPlace(listing, number)); }
