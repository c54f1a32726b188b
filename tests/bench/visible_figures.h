// Counts drawn and visible clusters and triangles of a frame, from dumps of `hearth-render
// --dump-visibility`.
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
    uint64_t owning_clusters = 0; ///< visible in at least one pixel
    uint64_t drawn_triangles = 0;
    uint64_t owning_triangles = 0;
    uint64_t covered_pixels = 0;

    void add(const VisibleFigures& other);
    double trianglesPerPixel() const;
    double drawnOverOwning() const; ///< ratio of clusters
};

/// Figures of each kind of object. The kind is the part of the mesh's name before the first '_'.
using FiguresOfKind = std::map<std::string, VisibleFigures>;

/// errors: input_missing; usage if the file is no dump of that pack.
Result<FiguresOfKind> readVisibleFigures(const std::string& path, const formats::PackView& pack);

VisibleFigures sumUp(const FiguresOfKind& figures);

} // namespace hearth::bench
