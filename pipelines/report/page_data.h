// What the page of a report shows, as the script in it reads it: less than the report, and in rows where there are many.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/report/pictures.h"

#include <string>
#include <vector>

namespace hearth::report
{

/// report   JSON, as below
/// returns  JSON. Throws JsonError where the report is not as its schema says.
std::string pageData(const std::string& report);

/// The meshes of the report that are worth a picture, first those that matter most: the largest of each asset, by size, then all
/// others by size.
std::vector<MeshOfPack> importantMeshes(const std::string& report);

/// JSON: the pictures as data URIs, and what was left out.
std::string picturesData(const Pictures& pictures);

} // namespace hearth::report
