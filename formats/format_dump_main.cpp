// format_dump: regenerates the tables of FORMAT.md in place.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/regular_file.h"
#include "formats/format_tables.h"

#include <cstdio>
#include <fstream>

int main(int argument_count, char** arguments)
{
    if (argument_count != 2)
    {
        std::fputs("usage: format_dump FORMAT.md\n", stderr);
        return 2;
    }
    const hearth::Result<std::string> document = hearth::readFile(arguments[1]);
    if (!document)
    {
        std::fprintf(stderr, "%s\n", hearth::formatMessage(document.error()).c_str());
        return hearth::exitCode(document.error());
    }
    std::ofstream out(arguments[1], std::ios::binary);
    out << hearth::formats::regenerateTables(*document);
    out.close();
    if (!out)
    {
        std::fprintf(stderr, "%s: error: cannot write\n", arguments[1]);
        return 73;
    }
    return 0;
}
