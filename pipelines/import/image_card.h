// Imports a single image as a card.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <cstddef>
#include <span>
#include <string>

namespace hearth::import
{

/// Import a single image as an unlit card, one metre high, so that it can be cooked and viewed by itself.
Status importImage(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                   PartBuilder& part);

} // namespace hearth::import
