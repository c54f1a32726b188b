// Report of inspect --topology: as text, as JSON, and as geometry to look at.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/topology/findings.h"

#include <string>
#include <vector>

namespace hearth::command
{

struct TopologyReport
{
    std::string source;
    std::string not_checked;          ///< why self-intersections were not checked; empty if they were
    std::vector<MeshFindings> meshes; ///< in the order of the source
    /// world_from_object of the first instance of each mesh; of a mesh without instances the identity
    std::vector<Affine3> placements;
};

/// Return the report for people: meshes with findings, the worst first, then advice for each kind.
std::string topologyText(const TopologyReport& report);

/// Return the report as JSON, schema "hearth.topology/1".
std::string topologyJson(const TopologyReport& report);

/// Return findings as a binary PLY file in world space: points, edges and faces in the colours of their
/// kinds, which the header's comments list.
/// only  one kind; nullopt: all
std::string topologyPly(const TopologyReport& report, std::optional<Finding> only);

} // namespace hearth::command
