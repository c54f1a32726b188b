// format_dump: regenerates the tables of FORMAT.md in place.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/format_tables.h"

#include <cstdio>
#include <fstream>
#include <iterator>

int main(int argument_count, char** arguments)
{
    if (argument_count != 2)
    {
        std::fputs("usage: format_dump FORMAT.md\n", stderr);
        return 2;
    }
    std::ifstream in(arguments[1], std::ios::binary);
    if (!in)
    {
        std::fprintf(stderr, "%s: error: cannot read\n", arguments[1]);
        return 66;
    }
    const std::string document{std::istreambuf_iterator<char>(in), {}};
    in.close();
    std::ofstream out(arguments[1], std::ios::binary);
    out << hearth::formats::regenerateTables(document);
    out.close();
    if (!out)
    {
        std::fprintf(stderr, "%s: error: cannot write\n", arguments[1]);
        return 73;
    }
    return 0;
}
