// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/parallel.h"

#include <tbb/parallel_for.h>

namespace hearth::samples
{

void parallelFor(size_t count, const std::function<void(size_t)>& body)
{
    tbb::parallel_for(size_t{0}, count, body);
}

} // namespace hearth::samples
