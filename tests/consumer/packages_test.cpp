// Tests the Debian packages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/consumer/installation.h"

namespace hearth::test
{

using Packages = Installation;

TEST_F(Packages, holdWhatTheirNamesSay)
{
    if (shell("command -v dpkg-shlibdeps").exit_code != 0)
        GTEST_SKIP() << "dpkg-shlibdeps is not installed";
    // compression would take most of the time
    run(HEARTH_CPACK " --config " HEARTH_BUILD_FOLDER
                     "/CPackConfig.cmake -G DEB -B debs -D CPACK_DEBIAN_COMPRESSION_TYPE=none");
    const auto content = [](const std::string& package)
    { return run("dpkg-deb --contents debs/" + package + "_*.deb"); };
    const auto field = [](const std::string& package, const std::string& name)
    { return run("dpkg-deb --field debs/" + package + "_*.deb " + name); };

    for (const char* program : {"hearth", "hearth-import", "hearth-clusters", "hearth-link", "hearth-render"})
        EXPECT_EQ(countOccurrences(content("hearth"), std::string("./usr/bin/") + program + "\n"), 1u)
            << program;
    EXPECT_EQ(countOccurrences(content("hearth"), "./usr/bin/hearth-view\n"), 0u);
    EXPECT_EQ(countOccurrences(content("hearth"), "./usr/lib"), 0u);
    // the GPL of CGAL is that of one package alone
    EXPECT_EQ(countOccurrences(content("hearth"), "./usr/bin/hearth-wrap\n"), 0u);
#ifdef HEARTH_HAS_WRAP
    EXPECT_EQ(countOccurrences(content("hearth-wrap"), "./usr/bin/"), 2u) << "the folder and the program";
    EXPECT_EQ(countOccurrences(content("hearth-wrap"), "./usr/bin/hearth-wrap\n"), 1u);
    EXPECT_EQ(countOccurrences(field("hearth-wrap", "Depends"), "libgmp10 ("), 1u);
#endif
    for (const char* needed : {"libc6 (", "libtbb12 (", "libembree3-3 (", "libvulkan1"})
        EXPECT_EQ(countOccurrences(field("hearth", "Depends"), needed), 1u) << needed;

    const std::string runtime = content("libhearth1");
    EXPECT_EQ(countOccurrences(runtime, "libhearth.so.1"), 3u) << runtime; // a link and its target
    EXPECT_EQ(countOccurrences(runtime, "libhearth.so\n") + countOccurrences(runtime, "libhearth.so "), 0u)
        << runtime;
    const std::string needs = field("libhearth1", "Depends");
    for (const char* needed : {"libc6 (", "libstdc++6 (", "libxxhash0 (", "libzstd1 ("})
        EXPECT_EQ(countOccurrences(needs, needed), 1u) << needs;
    EXPECT_EQ(countOccurrences(needs, "tbb") + countOccurrences(needs, "embree"), 0u) << needs;

    const std::string development = content("libhearth-dev");
    for (const char* file :
         {"include/hearth/hearth.h\n", "include/hearth/hearth.hpp\n", "include/hearth/hearth_helpers.h\n",
          "include/hearth/formats/pack/pack_view.h\n", "include/hearth/formats/gpu_shared/records.h\n",
          "/libhearth.a\n", "/libhearth-formats.a\n", "/libhearth-helpers.a\n",
          "/pkgconfig/hearth-helpers.pc\n", "/examples/draw_image.c\n", "/libhearth.so ->",
          "/pkgconfig/hearth.pc\n", "/hearthConfig.cmake\n", "/HearthAddAssets.cmake\n"})
        EXPECT_EQ(countOccurrences(development, file), 1u) << file;
    EXPECT_NE(field("libhearth-dev", "Depends").find("libhearth1 (= "), std::string::npos);

#ifdef HEARTH_HAS_BINDINGS
    const std::string bindings = content("hearth-bindings");
    for (const char* file : {"/share/hearth/bindings/hearth.py\n", "/share/hearth/bindings/Hearth.cs\n",
                             "/bindings/examples/draw_image.py\n", "/bindings/examples/DrawImage.cs\n",
                             "/bindings/bindings.md\n", "/libhearth-helpers.so.1 ->"})
        EXPECT_EQ(countOccurrences(bindings, file), 1u) << file;
    EXPECT_NE(field("hearth-bindings", "Depends").find("libhearth1 (= "), std::string::npos);
#endif
}

} // namespace hearth::test
