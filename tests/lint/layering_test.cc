// The architecture as a table, and the tests that hold the code to it.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/lint/source_files.h"

namespace haarmony::lint {
namespace {

// A file below `folder` may include what lies below `may_use`, and nothing else of ours.
// The longest matching folder counts.
struct Layer {
    std::string_view folder;
    std::vector<std::string_view> may_use;
};

const std::vector<Layer>& layers() {
    static const std::vector<Layer> table = {
        {"engine/core", {"engine/core"}},
        {"engine/image", {"engine/core", "engine/image"}},
        {"engine/curve", {"engine/core", "engine/curve"}},
        {"engine/video", {"engine/core", "engine/video"}},
        {"schema", {"engine/core", "schema"}},
        {"ingest", {"engine", "schema", "ingest"}},
        {"ingest/gallery", {"engine/core", "ingest/gallery", "ingest/thumbnail.h"}},
        {"server/http", {"engine/core", "server/http"}},
        {"server/app", {"engine", "schema", "ingest", "server/app"}},
        {"server/api", {"engine", "schema", "ingest", "server"}},
        {"server", {"engine", "schema", "ingest", "server"}},
    };
    return table;
}

// A header whose path starts with `header` may be included below `folders` only.
struct Reserved {
    std::string_view header;
    std::vector<std::string_view> folders;
};

const std::vector<Reserved>& reserved() {
    static const std::vector<Reserved> table = {
        {"sqlite3.h", {"schema"}},
        {"boost/", {"server/http", "server/main"}},
        {"nlohmann/", {"schema", "ingest", "server"}},
        {"spdlog/", {"ingest/main", "server/app", "server/main", "server/log"}},
        {"OpenImageIO/", {"ingest"}},
        {"jpeglib.h", {"ingest"}},
        {"curl/", {"ingest"}},
        {"libavcodec/", {"ingest"}},
        {"libavformat/", {"ingest"}},
        {"libavutil/", {"ingest"}},
        {"libswscale/", {"ingest"}},
        {"CLI/", {"ingest", "server"}},
        // The engine starts no threads, opens no files and prints nothing.
        {"thread", {"schema", "ingest", "server"}},
        {"future", {"ingest", "server"}},
        {"fstream", {"schema", "ingest", "server"}},
        {"filesystem", {"schema", "ingest", "server"}},
        {"iostream", {"schema", "ingest", "server"}},
        {"cstdio", {"schema", "ingest", "server"}},
    };
    return table;
}

bool below(std::string_view path, std::string_view folder) {
    if (!path.starts_with(folder)) return false;
    const std::string_view rest = path.substr(folder.size());
    return rest.empty() || folder.ends_with('/') || rest.front() == '/' ||
           rest.front() == '.' || rest.front() == '_';
}

const Layer* layer_of(std::string_view path) {
    const Layer* found = nullptr;
    for (const Layer& layer : layers()) {
        if (below(path, layer.folder) &&
            (found == nullptr || layer.folder.size() > found->folder.size())) {
            found = &layer;
        }
    }
    return found;
}

bool below_any(std::string_view path, const std::vector<std::string_view>& folders) {
    for (const std::string_view folder : folders) {
        if (below(path, folder)) return true;
    }
    return false;
}

std::vector<std::string> product_files() {
    return source_files({"engine", "schema", "ingest", "server"});
}

TEST(Layering, EveryProductFileBelongsToALayer) {
    const std::vector<std::string> files = product_files();
    ASSERT_GT(files.size(), 20U);
    for (const std::string& path : files) EXPECT_NE(layer_of(path), nullptr) << path;
}

TEST(Layering, OurHeadersAreIncludedOnlyDownwards) {
    for (const std::string& path : product_files()) {
        const Layer* layer = layer_of(path);
        if (layer == nullptr) continue;
        for (const Include& include : includes_of(read_file(path))) {
            if (!include.quoted) continue;
            EXPECT_TRUE(below_any(include.path, layer->may_use))
                << path << ":" << include.line << " includes " << include.path;
        }
    }
}

TEST(Layering, ReservedLibrariesStayInTheirFolders) {
    for (const std::string& path : product_files()) {
        for (const Include& include : includes_of(read_file(path))) {
            for (const Reserved& rule : reserved()) {
                const bool is_prefix = rule.header.ends_with('/');
                const bool hit = is_prefix ? include.path.starts_with(rule.header)
                                           : include.path == rule.header;
                if (!hit || include.quoted) continue;
                EXPECT_TRUE(below_any(path, rule.folders))
                    << path << ":" << include.line << " includes <" << include.path
                    << ">";
            }
        }
    }
}

TEST(Layering, NoProductFileIncludesTests) {
    for (const std::string& path : product_files()) {
        for (const Include& include : includes_of(read_file(path))) {
            EXPECT_FALSE(include.path.starts_with("tests/"))
                << path << ":" << include.line;
        }
    }
}

TEST(Layering, EveryHeaderIsGuardedOnce) {
    for (const std::string& path : product_files()) {
        if (!path.ends_with(".h")) continue;
        EXPECT_NE(read_file(path).find("#pragma once"), std::string::npos) << path;
    }
}

TEST(LayeringTable, SeesAnIncludeThatPointsUpwards) {
    const auto includes = includes_of("#include \"server/http/router.h\"\n");
    ASSERT_EQ(includes.size(), 1U);
    EXPECT_FALSE(below_any(includes[0].path, layer_of("engine/image/haar.cc")->may_use));
    EXPECT_EQ(layer_of("ingest/gallery/flag.cc")->folder, "ingest/gallery");
    EXPECT_EQ(layer_of("ingest/decode.cc")->folder, "ingest");
    EXPECT_EQ(layer_of("engineering/x.cc"), nullptr);
}

}  // namespace
}  // namespace haarmony::lint
