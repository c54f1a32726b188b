// Surface before or after a simplification, with its search structures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/facet.h"
#include "cook/clusters/surface/piece_bound.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Lists of numbers in one array (compressed sparse rows).
class NumberLists
{
public:
    /// Append i / N to list keys[i], or to none if that is not below `list_count`.
    template <uint32_t N>
    static NumberLists byKey(size_t list_count, std::span<const uint32_t> keys)
    {
        NumberLists lists;
        lists.offsets_.assign(list_count + 1, 0);
        for (const uint32_t key : keys)
            if (key < list_count)
                ++lists.offsets_[key + 1];
        for (size_t i = 1; i < lists.offsets_.size(); ++i)
            lists.offsets_[i] += lists.offsets_[i - 1];
        lists.items_.resize(lists.offsets_.back());
        std::vector<uint32_t> next(lists.offsets_.begin(), lists.offsets_.end() - 1);
        for (uint32_t i = 0; i < keys.size(); ++i)
            if (keys[i] < list_count)
                lists.items_[next[keys[i]]++] = i / N;
        return lists;
    }

    std::span<const uint32_t> of(uint32_t key) const
    {
        return std::span(items_).subspan(offsets_[key], offsets_[key + 1] - offsets_[key]);
    }

private:
    std::vector<uint32_t> offsets_;
    std::vector<uint32_t> items_;
};

/// Triangulated surface of a group; all arrays are in local units.
struct Surface
{
    std::vector<uint32_t> positions; ///< position ids, three for each triangle
    std::vector<Float3> places;      ///< positions of the same corners
    std::vector<Facet> facets;
    std::vector<Float3> place_of_position;
    NumberLists facets_at; ///< triangles at each position

    /// positions          position ids, three for each triangle
    /// place_of_position  position of every position id
    Surface(std::vector<uint32_t> corner_positions, std::span<const Float3> all_places)
        : positions(std::move(corner_positions)),
          places(placesOf(positions, all_places)),
          facets(facetsOf(places)),
          place_of_position(all_places.begin(), all_places.end()),
          facets_at(NumberLists::byKey<3>(all_places.size(), positions))
    {
    }

    /// Move the positions; the triangles stay the same.
    void setPlaces(std::span<const Float3> all_places)
    {
        places = placesOf(positions, all_places);
        facets = facetsOf(places);
        place_of_position.assign(all_places.begin(), all_places.end());
    }

    size_t facetCount() const { return positions.size() / 3; }
    Corners cornersOf(size_t facet) const
    {
        return {places[facet * 3], places[facet * 3 + 1], places[facet * 3 + 2]};
    }

private:
    static std::vector<Facet> facetsOf(std::span<const Float3> places)
    {
        std::vector<Facet> facets;
        facets.reserve(places.size() / 3);
        for (size_t corner = 0; corner < places.size(); corner += 3)
            facets.push_back(makeFacet(places[corner], places[corner + 1], places[corner + 2]));
        return facets;
    }

    static std::vector<Float3> placesOf(std::span<const uint32_t> positions,
                                        std::span<const Float3> place_of_position)
    {
        std::vector<Float3> places;
        places.reserve(positions.size());
        for (const uint32_t position : positions)
            places.push_back(place_of_position[position]);
        return places;
    }
};

} // namespace hearth::clusters
