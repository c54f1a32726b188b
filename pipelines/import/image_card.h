// Imports a lone image as a card.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <cstddef>
#include <span>
#include <string>

namespace hearth::import
{

/// A lone image becomes an unlit card, one metre high, so that it can be cooked and looked at by itself.
Status importImage(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                   PartBuilder& part);

} // namespace hearth::import
