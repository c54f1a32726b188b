// draw_architecture ROOT: prints docs/architecture.svg.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/layering/architecture_drawing.h"

#include <cstdio>

int main(int argc, char** argv)
{
    if (argc != 2)
        return 2;
    std::fputs(hearth::test::drawFolderGraph(hearth::test::readFolderGraph(argv[1])).c_str(), stdout);
    return 0;
}
