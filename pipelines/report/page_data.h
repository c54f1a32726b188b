// Data of a report's page, in the form that its script reads: a subset of the report, with long lists as
// rows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/report/images.h"
#include "pipelines/report/light_images.h"

#include <string>
#include <vector>

namespace hearth::report
{

/// Convert a report into the data of its page.
/// report   JSON of schema hearth.report/1
/// returns  JSON. Throws JsonError where the report violates its schema.
std::string pageData(const std::string& report);

/// Return the meshes that deserve an image, most important first: the largest of each asset, by size, then
/// all others by size.
std::vector<PackMesh> importantMeshes(const std::string& report);

/// Return the images as JSON with data URIs, and the number of meshes without one.
std::string imagesData(const Images& images, const std::vector<LightImage>& light = {});

} // namespace hearth::report
