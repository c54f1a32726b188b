// Compares everything that an import part holds of a glTF file with what tinygltf reads of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "tests/import_values/comparison.h"
#include "tests/import_values/source_model.h"

#include <string>

namespace hearth::test
{

// Each compares one section.
void compareMeshes(const SourceModel& source, const formats::PackView& part, Comparison& comparison);
void compareNodes(const SourceModel& source, const formats::PackView& part, Comparison& comparison);
void compareInstances(const SourceModel& source, const formats::PackView& part, Comparison& comparison);
void compareSkins(const SourceModel& source, const formats::PackView& part, Comparison& comparison);
void compareAnimations(const SourceModel& source, const formats::PackView& part, Comparison& comparison);
void compareMaterials(const SourceModel& source, const formats::PackView& part, Comparison& comparison);

/// Compare all sections of a file with its part, which hearth-import has made with animation.error=0.
/// name  of the file, in the report
Comparison comparePart(const std::string& source_path, const std::string& part_path, const std::string& name);

} // namespace hearth::test
