// Fuzzes a pack with libFuzzer. The input is tried as it is, which exercises the container, and once more
// with corrected hashes, so that the search reaches the semantic checker.
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
