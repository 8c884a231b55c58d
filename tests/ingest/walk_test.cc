#include "ingest/walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/fsuid.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ingest/file_descriptor.h"
#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr std::string_view kPngBegin = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR";

struct Walked {
    std::vector<std::string> files;
    std::vector<std::string> failures;  // "PATH: message"
    WalkSummary summary;
};

Walked walk_all(const std::vector<std::string>& paths, const WalkOptions& options = {}) {
    Walked walked;
    walked.summary = walk(paths,
                          options,
                          {[&](FoundFile file) {
                               walked.files.push_back(std::move(file.path));
                               return true;
                           },
                           [&](const std::string& path, const Error& error) {
                               walked.failures.push_back(path + ": " + error.message);
                               return true;
                           },
                           [] { return true; }});
    return walked;
}

WalkOptions excluding(const std::vector<std::string>& globs) {
    WalkOptions options;
    for (const std::string& glob : globs) options.exclude.emplace_back(glob);
    return options;
}

TEST(Walk, FindsPicturesByExtensionInAnyCaseAndByMagic) {
    const ScratchFolder folder;
    folder.write("a.jpg", "");
    folder.write("b.PNG", "x");
    folder.write("c", kPngBegin);
    folder.write("d.txt", kPngBegin);
    folder.write("e.txt", "text");
    folder.write("f", "");
    folder.write("g.pdf", "%PDF-1.4");
    const Walked walked = walk_all({folder.path()});
    EXPECT_THAT(
        walked.files,
        ElementsAre(folder / "a.jpg", folder / "b.PNG", folder / "c", folder / "d.txt"));
    EXPECT_THAT(walked.failures, IsEmpty());
    EXPECT_TRUE(walked.summary.finished);
    EXPECT_THAT(walked.summary.reached, ElementsAre(folder.path()));
}

TEST(Walk, FindsFilmsWhenAskedToAndNoSoundInTheirContainers) {
    const ScratchFolder folder;
    const std::string matroska = "\x1a\x45\xdf\xa3";
    folder.write("a.MP4", "");
    folder.write("b", matroska);
    folder.write("c.mka", matroska);
    folder.write("d.opus", "OggS");
    folder.write("e.ts", "const source = 'text';");
    folder.write("f.png", "");
    const auto films_too = [](bool films) {
        WalkOptions options;
        options.films = films;
        return options;
    };
    EXPECT_THAT(walk_all({folder.path()}, films_too(false)).files,
                ElementsAre(folder / "f.png"));
    EXPECT_THAT(walk_all({folder.path()}, films_too(true)).files,
                ElementsAre(folder / "a.MP4", folder / "b", folder / "f.png"));
}

TEST(Walk, OrderIsFilesByNameThenFoldersByName) {
    const ScratchFolder folder;
    for (const char* name :
         {"b/2.png", "b/1.png", "a/z/1.png", "a/9.png", "z.png", "B.png"}) {
        folder.write(name, "");
    }
    EXPECT_THAT(walk_all({folder.path()}).files,
                ElementsAre(folder / "B.png",
                            folder / "z.png",
                            folder / "a/9.png",
                            folder / "a/z/1.png",
                            folder / "b/1.png",
                            folder / "b/2.png"));
}

TEST(Walk, HiddenFilesAndNamesOfAnyBytesAreLikeAnyOther) {
    const ScratchFolder folder;
    folder.write(".hidden/.a.png", "");
    folder.write("\xff\x01 \n.png", "");
    EXPECT_THAT(walk_all({folder.path()}).files,
                ElementsAre(folder / "\xff\x01 \n.png", folder / ".hidden/.a.png"));
}

TEST(Walk, TellsSizeAndTimeOfTheFile) {
    const ScratchFolder folder;
    folder.write("a.png", "12345", kLongAgoNs + 7);
    std::vector<FileLook> looks;
    (void)walk({folder.path()},
               {},
               {[&](const FoundFile& file) {
                    looks.push_back(file.look);
                    return true;
                },
                [](const std::string&, const Error&) { return true; },
                [] { return true; }});
    EXPECT_THAT(looks, ElementsAre(FileLook{5, kLongAgoNs + 7}));
}

TEST(Walk, FollowsLinksToFilesButNotToFolders) {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    elsewhere.write("inside.png", "");
    const std::string target = elsewhere.write("target", kPngBegin);
    ASSERT_EQ(::symlink(elsewhere.path().c_str(), (folder / "folder").c_str()), 0);
    ASSERT_EQ(::symlink(target.c_str(), (folder / "file").c_str()), 0);
    ASSERT_EQ(::symlink("nowhere", (folder / "dangling.png").c_str()), 0);
    ASSERT_EQ(::symlink("loop.png", (folder / "loop.png").c_str()), 0);
    const Walked walked = walk_all({folder.path()});
    EXPECT_THAT(walked.files, ElementsAre(folder / "file"));
    EXPECT_THAT(walked.failures, IsEmpty());
}

TEST(Walk, FollowsNoLinkWhereThatIsAskedFor) {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    const std::string target = elsewhere.write("target.png", kPngBegin);
    ASSERT_EQ(::symlink(target.c_str(), (folder / "link.png").c_str()), 0);
    const std::string file = folder.write("file.png", kPngBegin);
    WalkOptions options;
    options.file_links = false;
    EXPECT_THAT(walk_all({folder.path()}, options).files, ElementsAre(file));
}

TEST(Walk, FollowsALinkThatIsItselfAPath) {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    elsewhere.write("inside.png", "");
    ASSERT_EQ(::symlink(elsewhere.path().c_str(), (folder / "link").c_str()), 0);
    EXPECT_THAT(walk_all({folder / "link"}).files,
                ElementsAre(folder / "link/inside.png"));
}

TEST(Walk, IgnoresSpecialFilesWithoutOpeningThem) {
    const ScratchFolder folder;
    // Opening either fifo would wait for ever.
    ASSERT_EQ(::mkfifo((folder / "fifo.png").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = folder / "socket.png";
    ASSERT_LT(name.size(), sizeof address.sun_path);
    name.copy(address.sun_path, name.size());
    ASSERT_EQ(::bind(server, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const Walked walked = walk_all({folder.path()});
    ::close(server);
    EXPECT_THAT(walked.files, IsEmpty());
    EXPECT_THAT(walked.failures, IsEmpty());
}

TEST(Walk, APathThatIsASpecialFileIsAFailure) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo((folder / "fifo.png").c_str(), 0600), 0);
    const Walked walked = walk_all({folder / "fifo.png"});
    EXPECT_THAT(walked.failures,
                ElementsAre(folder / "fifo.png: is neither a file nor a folder"));
    EXPECT_THAT(walked.summary.reached, IsEmpty());
}

TEST(Walk, APathThatIsAFileIsACandidateWhateverItLooksLike) {
    const ScratchFolder folder;
    const std::string path = folder.write("notes.txt", "text");
    EXPECT_THAT(walk_all({path}).files, ElementsAre(path));
}

TEST(Walk, AMissingPathIsAFailureAndTheOthersAreWalked) {
    const ScratchFolder folder;
    folder.write("a.png", "");
    const Walked walked = walk_all({folder / "gone", folder.path()});
    EXPECT_THAT(walked.files, ElementsAre(folder / "a.png"));
    EXPECT_THAT(walked.failures, ElementsAre(folder / "gone: No such file or directory"));
    EXPECT_THAT(walked.summary.reached, ElementsAre(folder.path()));
}

TEST(Walk, OverlappingPathsGiveEachFileOnce) {
    const ScratchFolder folder;
    const std::string a = folder.write("a.png", "");
    const std::string b = folder.write("x/b.png", "");
    const std::string c = folder.write("x/y/c.png", "");
    const std::string x = folder / "x";
    const std::string y = folder / "x/y";
    const std::vector<std::vector<std::string>> orders = {
        {folder.path(), x},
        {x, folder.path()},
        {y, folder.path(), x},
        {folder.path(), folder.path()},
        {c, folder.path(), c},
        {x + "/../x/", folder.path() + "//"},
        {folder.path(), y, b}};
    for (const auto& paths : orders) {
        EXPECT_THAT(walk_all(paths).files, UnorderedElementsAre(a, b, c))
            << testing::PrintToString(paths);
    }
}

TEST(Walk, ExcludedFoldersAreNotEnteredUnlessTheyAreAPath) {
    const ScratchFolder folder;
    folder.write("keep.png", "");
    folder.write("drop.tmp.png", "");
    folder.write("cache/a.png", "");
    const Walked walked = walk_all({folder.path()}, excluding({"cache", "*.tmp.*"}));
    EXPECT_THAT(walked.files, ElementsAre(folder / "keep.png"));
    EXPECT_THAT(walk_all({folder / "cache"}, excluding({"cache"})).files,
                ElementsAre(folder / "cache/a.png"));
    EXPECT_THAT(
        walk_all({folder.path(), folder / "cache"}, excluding({"cache", "*.tmp.*"}))
            .files,
        ElementsAre(folder / "keep.png", folder / "cache/a.png"));
    EXPECT_THAT(walk_all({folder / "drop.tmp.png"}, excluding({"*.tmp.*"})).files,
                IsEmpty());
}

TEST(Walk, PatternsWithASlashCountFromThePath) {
    const ScratchFolder folder;
    folder.write("a/b/1.png", "");
    folder.write("b/1.png", "");
    EXPECT_THAT(walk_all({folder.path()}, excluding({"b/*.png"})).files,
                ElementsAre(folder / "a/b/1.png"));
}

TEST(Walk, TheDatabasesOwnFilesAreNoCandidates) {
    const ScratchFolder folder;
    const std::string database = folder.write("pictures.png", "");
    folder.write("pictures.png-wal", kPngBegin);
    folder.write("other.png", "");
    ASSERT_EQ(::symlink(database.c_str(), (folder / "link.png").c_str()), 0);
    WalkOptions options;
    options.own_files = database_files(database);
    EXPECT_THAT(walk_all({folder.path()}, options).files,
                ElementsAre(folder / "other.png"));
    EXPECT_THAT(walk_all({database}, options).failures,
                ElementsAre(database + ": is the database itself"));
}

// Root reads every folder; another user's eyes are needed to be refused.
class AsNobody {
  public:
    AsNobody() : before_(::setfsuid(65534)) {}
    ~AsNobody() { ::setfsuid(static_cast<uid_t>(before_)); }

  private:
    int before_;
};

TEST(Walk, AFolderThatCannotBeReadIsAFailureAndTheWalkGoesOn) {
    const ScratchFolder folder;
    ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
    folder.write("closed/a.png", "");
    folder.write("open/b.png", "");
    ASSERT_EQ(::chmod((folder / "closed").c_str(), 0), 0);
    Walked walked;
    {
        const AsNobody nobody;
        walked = walk_all({folder.path(), folder / "closed"});
    }
    ASSERT_EQ(::chmod((folder / "closed").c_str(), 0755), 0);
    EXPECT_THAT(walked.files, ElementsAre(folder / "open/b.png"));
    EXPECT_THAT(walked.failures, ElementsAre(folder / "closed: Permission denied"));
    EXPECT_THAT(walked.summary.reached, ElementsAre(folder.path()));
}

TEST(Walk, EndsWhereAnEventSaysSo) {
    const ScratchFolder folder;
    for (const char* name : {"1.png", "2.png", "x/3.png", "y/4.png"})
        folder.write(name, "");
    for (int most = 0; most < 4; ++most) {
        int asked = 0;
        std::vector<std::string> files;
        const WalkSummary summary =
            walk({folder.path()},
                 {},
                 {[&](FoundFile file) {
                      files.push_back(std::move(file.path));
                      return static_cast<int>(files.size()) <= most;
                  },
                  [](const std::string&, const Error&) { return true; },
                  [&] { return ++asked < 1000; }});
        EXPECT_FALSE(summary.finished);
        EXPECT_EQ(files.size(), static_cast<std::size_t>(most) + 1);
    }
    for (int most = 0; most < 4; ++most) {
        int asked = 0;
        const WalkSummary summary =
            walk({folder.path()},
                 {},
                 {[](const FoundFile&) { return true; },
                  [](const std::string&, const Error&) { return true; },
                  [&] { return ++asked <= most; }});
        EXPECT_FALSE(summary.finished);
        EXPECT_EQ(asked, most + 1);
    }
}

// Folders nested until their path is longer than the kernel takes in one piece.
class DeepTree {
  public:
    DeepTree(const ScratchFolder& folder, int depth, const std::string& name)
        : name_(name) {
        std::string path = folder.path();
        FileDescriptor open = open_path(path, O_PATH | O_DIRECTORY);
        for (int i = 0; i < depth; ++i) {
            EXPECT_EQ(::mkdirat(open.get(), name.c_str(), 0755), 0);
            const int next = ::openat(open.get(), name.c_str(), O_PATH | O_DIRECTORY);
            open = FileDescriptor(next);
            path += '/' + name;
        }
        const FileDescriptor file(
            ::openat(open.get(), "a.png", O_CREAT | O_WRONLY, 0644));
        EXPECT_TRUE(file.valid());
        file_ = path + "/a.png";
        folder_ = path;
    }
    ~DeepTree() {
        // From the innermost outwards: no recursion and no path too long here either.
        while (true) {
            const FileDescriptor inner = open_path(folder_, O_PATH | O_DIRECTORY);
            ::unlinkat(inner.get(), "a.png", 0);
            const std::size_t slash = folder_.rfind('/');
            if (folder_.substr(slash + 1) != name_) break;
            folder_.resize(slash);
            const FileDescriptor outer = open_path(folder_, O_PATH | O_DIRECTORY);
            ::unlinkat(outer.get(), name_.c_str(), AT_REMOVEDIR);
        }
    }

    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    std::string name_;
    std::string file_;
    std::string folder_;
};

TEST(Walk, DeepTreesNeedNoMoreDescriptorsThanFlatOnes) {
    const ScratchFolder folder;
    const DeepTree tree(folder, 300, "d");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit few{64, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    const Walked walked = walk_all({folder.path()});
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
    EXPECT_THAT(walked.files, ElementsAre(tree.file()));
    EXPECT_THAT(walked.failures, IsEmpty());
}

TEST(Walk, PathsMayBeLongerThanTheKernelTakesInOnePiece) {
    const ScratchFolder folder;
    const DeepTree tree(folder, 60, std::string(250, 'n'));
    ASSERT_GT(tree.file().size(), 3u * PATH_MAX);
    EXPECT_THAT(walk_all({folder.path()}).files, ElementsAre(tree.file()));
    EXPECT_THAT(walk_all({tree.file()}).files, ElementsAre(tree.file()));
}

TEST(LookOf, TimesBeyondNanosecondsOfInt64AreCut) {
    struct stat status {};
    status.st_mtim = {-5, 3};
    EXPECT_EQ(look_of(status).mtime_ns, -5 * std::int64_t{1'000'000'000} + 3);
    status.st_mtim.tv_sec = std::numeric_limits<time_t>::max();
    EXPECT_EQ(look_of(status).mtime_ns, std::numeric_limits<std::int64_t>::max());
    status.st_mtim.tv_sec = std::numeric_limits<time_t>::min();
    EXPECT_EQ(look_of(status).mtime_ns, std::numeric_limits<std::int64_t>::min());
}

}  // namespace
}  // namespace haarmony::ingest
