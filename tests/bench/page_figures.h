// What the pages of a hierarchy take, and how fast they decode.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <string>
#include <vector>

namespace hearth::bench
{

struct PageFigures
{
    struct Kind
    {
        std::string name;
        double bytes; ///< shares of the pages' stored bytes, by the entropy of the streams
    };
    std::vector<Kind> kinds;
    double decoded_bytes = 0;
    double seconds = 0;      ///< to decode all pages, the least of several times
    double zstd_seconds = 0; ///< of these, what zstd takes
};

PageFigures pageFiguresOf(const clusters::Hierarchy& hierarchy);

} // namespace hearth::bench
