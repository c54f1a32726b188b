// What a frame drew and what of it is seen, from the dumps of `hearth-render --dump-visibility`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <map>
#include <string>

namespace hearth::bench
{

struct VisibleFigures
{
    uint64_t drawn_clusters = 0;
    uint64_t owning_clusters = 0; ///< seen in one pixel at least
    uint64_t drawn_triangles = 0;
    uint64_t owning_triangles = 0;
    uint64_t covered_pixels = 0;

    void add(const VisibleFigures& other);
    double trianglesPerPixel() const;
    double drawnOverOwning() const; ///< clusters
};

/// For each kind of object: what stands before the first '_' of its mesh's name.
using FiguresOfKind = std::map<std::string, VisibleFigures>;

/// errors: input_missing; usage, where the file is no dump of that pack.
Result<FiguresOfKind> readVisibleFigures(const std::string& path, const formats::PackView& pack);

VisibleFigures sumOf(const FiguresOfKind& figures);

} // namespace hearth::bench
