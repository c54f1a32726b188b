// Writes the seed packs of the fuzzers into a folder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/small_pack.h"

#include <cstdio>
#include <fstream>

int main(int argument_count, char** arguments)
{
    using namespace hearth::test;
    if (argument_count != 2)
    {
        std::fputs("usage: hearth_fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    for (const bool compressed : {false, true})
    {
        const AlignedBytes bytes = smallPack().bytes(compressed);
        std::ofstream file(std::string(arguments[1]) + (compressed ? "/compressed.hearth" : "/plain.hearth"),
                           std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.span().data()),
                   static_cast<std::streamsize>(bytes.size()));
        if (!file)
            return 73;
    }
    return 0;
}
