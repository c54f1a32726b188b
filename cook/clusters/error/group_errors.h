// Errors of drawing the replacement of a group: the error that chooses the cut, and its parts. See
// cook/clusters/README.md, "Normals and UVs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/attribute_error.h"

#include <cstdint>

namespace hearth::clusters
{

/// Errors in object space. No value falls from a group to its parents, except the parts at roots.
struct GroupErrors
{
    float lod = 0;      ///< error that chooses the cut; infinity for a root
    float position = 0; ///< bound of the distance to the source
    AttributeError attributes;
};

/// Return the errors of a root: nothing replaces it, so the error is infinite and its parts are 0.
GroupErrors rootErrors();

/// Errors of a replacement.
struct Replacement
{
    float distance = 0;       ///< to the source: includes the distances of the levels below
    AttributeStep attributes; ///< relative to what it replaces, or to the source
    float weight = 1;         ///< factor on the error that chooses the cut
};

/// Accumulated errors of the clusters that a group consists of.
class ErrorAccumulator
{
public:
    /// position  position error of the source itself
    explicit ErrorAccumulator(float position) : largest_{position, position, {}} {}

    void add(const GroupErrors& errors, uint32_t triangles);

    /// Return the errors of a replacement whose attributes were compared with what it replaces. An empty
    /// replacement leaves the errors unchanged.
    GroupErrors errorsOfReplacement(const Replacement& replacement, const Config& config) const;

    /// Return the errors of a replacement whose attributes were compared with the source's.
    GroupErrors errorsAgainstSource(const Replacement& replacement, const Config& config) const;

private:
    GroupErrors errorsWith(const AttributeError& attributes, const Replacement& replacement,
                           const Config& config) const;

    GroupErrors largest_;
    /// Sums over the triangles.
    double normal2_ = 0;
    double uv2_ = 0;
    double triangles_ = 0;
};

} // namespace hearth::clusters
