// Self-intersections of meshes, found by hearth-wrap: a program of its own, under the GPL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/topology/findings.h"

#include <map>
#include <string>

namespace hearth::command
{

struct SelfIntersectionCheck
{
    std::string not_checked;                      ///< why nothing was checked; empty if it was
    bool is_interrupted = false;                  ///< a signal asks this process to end
    std::map<uint32_t, SelfIntersections> meshes; ///< by mesh, those that were checked
};

/// Run `hearth-wrap PART --self-intersections FILE`, with the file in `folder`, where that program lies
/// beside this one.
/// subject  file that errors name
SelfIntersectionCheck findSelfIntersections(const std::string& part, const std::string& folder,
                                            const std::string& subject);

} // namespace hearth::command
