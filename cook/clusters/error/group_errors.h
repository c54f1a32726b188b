// What drawing in place of a group is off by: the error of the cut, and its parts. See cook/clusters/README.md, "Normals and UVs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/attribute_error.h"

#include <cstdint>

namespace hearth::clusters
{

/// Object space. None falls from a group to those above it, but for the parts of roots.
struct GroupErrors
{
    float lod = 0;      ///< as it counts for the cut; infinity for a root
    float position = 0; ///< a bound of the distance to the source
    AttributeError attributes;
};

/// Nothing replaces a root: the error is infinite, its parts are 0.
GroupErrors rootErrors();

/// What a replacement is off by.
struct Replacement
{
    float distance = 0;       ///< to the source: those below are part of it
    AttributeStep attributes; ///< against what it replaces, or the source
    float weight = 1;         ///< on the error of the cut
};

/// The errors of what a group is made of.
class ErrorsBelow
{
public:
    /// position  error of the source itself
    explicit ErrorsBelow(float position) : largest_{position, position, {}} {}

    void add(const GroupErrors& errors, uint32_t triangles);

    /// The errors of what replaces it all, whose attributes were compared with what it replaces. An empty replacement
    /// is what was there.
    GroupErrors plus(const Replacement& replacement, const Config& config) const;

    /// The same for one whose attributes were compared with the source's.
    GroupErrors orOf(const Replacement& replacement, const Config& config) const;

private:
    GroupErrors errorsWith(const AttributeError& attributes, const Replacement& replacement,
                           const Config& config) const;

    GroupErrors largest_;
    double normal2_ = 0; ///< sums over the triangles
    double uv2_ = 0;
    double triangles_ = 0;
};

} // namespace hearth::clusters
