// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/verify/verify_pack.h"

#include "formats/pack/pack_check.h"

#include <tbb/parallel_for.h>

namespace hearth::verify
{

Status verifyPack(const formats::PackView& view)
{
    return formats::checkPack(view, [](uint32_t count, const std::function<void(uint32_t)>& work)
                              { tbb::parallel_for(uint32_t{0}, count, work); });
}

} // namespace hearth::verify
