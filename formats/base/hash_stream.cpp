// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/hash_stream.h"

#define XXH_STATIC_LINKING_ONLY // XXH3_state_t on the stack
#include <xxhash.h>

namespace hearth
{

uint64_t hashStream(const std::function<std::span<const std::byte>()>& next)
{
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    for (std::span<const std::byte> piece = next(); !piece.empty(); piece = next())
        XXH3_64bits_update(&state, piece.data(), piece.size());
    return XXH3_64bits_digest(&state);
}

} // namespace hearth
