// Lists the kinds of samples, and generates them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "sample_assets/shapes/document.h"

#include <span>
#include <string_view>

namespace hearth::samples
{

struct SampleOptions
{
    uint64_t triangles = 0;    ///< target for the main mesh; 0: the kind's own default
    uint32_t texture_size = 0; ///< size of the rock's images; 0: the kind's own default
    uint32_t lights = 0;       ///< number of the market's lights; 0: the kind's own default
};

struct SampleKind
{
    std::string_view name;
    std::string_view summary;
    Document (*generate)(const SampleOptions& options);
};

std::span<const SampleKind> sampleKinds();

/// Make the sample of that name. errors: usage, naming the available kinds.
Result<Document> generateSample(std::string_view kind, const SampleOptions& options);

} // namespace hearth::samples
