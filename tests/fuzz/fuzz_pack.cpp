// libFuzzer: the input is a pack. It is tried as it is, which exercises the container, and once more with right hashes,
// so that the search gets past them to the checker of meaning.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/fuzz/exercise_pack.h"
#include "tests/support/container_image.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace hearth::test;
    AlignedBytes bytes(std::as_bytes(std::span(data, size)));
    static_cast<void>(exercisePack(bytes.span()).ok());
    repairPageHashes(bytes.span());
    repairHashes(bytes.span());
    static_cast<void>(exercisePack(bytes.span()).ok());
    return 0;
}
