// Draws the cut of a view in software, counts the triangles that it draws and those that are seen, and
// compares its image with that of all triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/bench/sample_image.h"
#include "tests/bench/view_cut.h"

#include <span>
#include <string>

namespace hearth::bench
{

/// Figures of a cut, in a view or summed over several.
struct CutFigures
{
    double clusters = 0;        ///< after frustum, cone and occlusion culling
    double facing_clusters = 0; ///< of these, with a triangle that faces the eye
    double uncovered_clusters =
        0;                    ///< with a pixel of their vertices' rectangle where the image is not nearer
    double seen_clusters = 0; ///< with a triangle at a pixel's sample
    double triangles = 0;
    double facing_triangles = 0; ///< of the seen clusters, those that face the eye
    double seen_triangles = 0;
    double pixels = 0;    ///< covered
    double flip = 0;      ///< one sample a pixel; sum over the covered pixels
    double flip_four = 0; ///< the same with four samples a pixel

    void add(const CutFigures& other);
    double trianglesPerPixel() const { return triangles / pixels; }
};

/// Measures cuts of one view.
class ViewMeter
{
public:
    /// scene, view  outlive the meter
    ViewMeter(const CutScene& scene, const shared::FrameView& view);

    /// images  beginning of the names of files to write; empty: none
    /// errors: cannot_write
    Result<CutFigures> measure(const CutRule& rule, const std::string& images = {}) const;

private:
    const CutScene& scene_;
    const shared::FrameView& view_;
    viewer::Image reference_; ///< of all triangles
};

} // namespace hearth::bench
