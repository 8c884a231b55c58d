#include "server/app/snapshot_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "server/app/file_descriptor.h"
#include "server/app/mapped_file.h"
#include "server/app/snapshot_format.h"

namespace haarmony::server {
namespace {

using Bytes = std::span<const std::byte>;

// Between two looks at whether to go on.
constexpr std::size_t kPiece = std::size_t{4} << 20;

// Whether the open file is the one of that name.
bool is_named(int descriptor, const std::string& path) {
    struct stat open {};
    struct stat named {};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
           open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

// An empty file of that name, which is this process's alone until it is closed.
Result<FileDescriptor> take_file(const std::string& path) {
    for (;;) {
        FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
        if (!file) return system_error(path, "written");
        if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
            return Error{ErrorCode::kUnavailable, path + ": another process writes it"};
        // Renamed by another process between open() and flock(): it is a snapshot now.
        if (!is_named(file.get(), path)) continue;
        if (::ftruncate(file.get(), 0) != 0) return system_error(path, "emptied");
        return file;
    }
}

Result<void> sync_folder_of(const std::string& path) {
    std::string folder = std::filesystem::path(path).parent_path().string();
    if (folder.empty()) folder = ".";
    const FileDescriptor opened(
        ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!opened) return system_error(folder, "opened");
    if (::fsync(opened.get()) != 0) return system_error(folder, "synchronised");
    return {};
}

// What of a segment's removals is written.
Bytes removed_bytes(const image::LiveSegment& live) {
    return live.removed == nullptr ? Bytes() : std::as_bytes(live.removed->words());
}

class Writer {
  public:
    Writer(const SnapshotContents& contents,
           const SnapshotWriting& writing,
           const std::string& partial)
        : writing_(writing), partial_(partial) {
        table_.sequence = contents.sequence;
        table_.index_m = static_cast<std::uint32_t>(contents.index_m);
        table_.damaged = contents.damaged;
        for (const auto& [variant, segments] : contents.segments) {
            const auto number = static_cast<std::uint32_t>(table_.variants.size());
            table_.variants.push_back(variant);
            for (const image::LiveSegment& live : segments) {
                // Nothing of it can be found.
                if (live.live() == 0) continue;
                parts_.push_back(&live);
                SnapshotPart part;
                part.variant = number;
                part.counts = live.segment->view().counts;
                assert(part.counts.index_m == table_.index_m);
                part.segment_bytes = bytes_of(live.segment->view()).size();
                part.has_removed = live.removed != nullptr;
                table_.parts.push_back(part);
            }
        }
        total_ = table_.file_bytes();
    }

    Result<void> write(FileDescriptor& file) {
        file_ = &file;
        place_ = table_.parts_begin();
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            SnapshotPart& part = table_.parts[i];
            const Bytes segment = bytes_of(parts_[i]->segment->view());
            if (Result<void> put = put_aligned(segment, part.segment_checksum); !put)
                return put;
            if (!part.has_removed) continue;
            const Bytes removed = removed_bytes(*parts_[i]);
            if (Result<void> put = put_aligned(removed, part.removed_checksum); !put)
                return put;
        }
        assert(place_ == total_);
        Result<schema::SnapshotToken> token = writing_.token();
        if (!token) return token.error();
        table_.token = token.value();
        if (Result<void> put = put_at(0, encode_table(table_)); !put) return put;
        if (::fsync(file.get()) != 0) return system_error(partial_, "synchronised");
        return {};
    }

    [[nodiscard]] std::uint64_t total() const { return total_; }

  private:
    // The bytes and zeros up to the next place where a part may begin.
    Result<void> put_aligned(Bytes bytes, std::uint64_t& checksum) {
        SnapshotChecksum sum;
        for (Bytes rest = bytes; !rest.empty();) {
            if (!writing_.go_on(place_, total_))
                return Error{ErrorCode::kUnavailable, partial_ + ": was stopped"};
            const Bytes piece = rest.first(std::min(rest.size(), kPiece));
            if (Result<void> put = put_next(piece, sum); !put) return put;
            rest = rest.subspan(piece.size());
        }
        static constexpr std::array<std::byte, kSnapshotAlignment> kZeros{};
        const std::size_t gap = aligned_in_snapshot(bytes.size()) - bytes.size();
        if (Result<void> put = put_next(Bytes(kZeros).first(gap), sum); !put) return put;
        checksum = sum.value();
        return {};
    }

    Result<void> put_next(Bytes bytes, SnapshotChecksum& sum) {
        sum.add(bytes);
        const std::uint64_t place = place_;
        place_ += bytes.size();
        return put_at(place, bytes);
    }

    Result<void> put_at(std::uint64_t place, Bytes bytes) {
        while (!bytes.empty()) {
            const ssize_t written =
                ::pwrite(file_->get(), bytes.data(), bytes.size(), off_t(place));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return system_error(partial_, "written");
            bytes = bytes.subspan(std::size_t(written));
            place += std::uint64_t(written);
        }
        return {};
    }

    const SnapshotWriting& writing_;
    const std::string& partial_;
    SnapshotTable table_;
    std::vector<const image::LiveSegment*> parts_;
    FileDescriptor* file_ = nullptr;
    std::uint64_t place_ = 0;
    std::uint64_t total_ = 0;
};

// What was written, as a reader will find it.
Result<void> check_written(int descriptor, const std::string& path, Executor& executor) {
    const auto file = MappedFile::of(descriptor, path);
    if (!file) return file.error();
    const Result<SnapshotTable> table = decode_table((*file)->bytes());
    if (!table) return table.error();
    const auto parts =
        read_parts(*file, table.value(), {image::view_segment, true}, executor);
    if (!parts) return parts.error();
    return {};
}

}  // namespace

Result<std::uint64_t> write_snapshot(const SnapshotContents& contents,
                                     const SnapshotWriting& writing,
                                     Executor& executor) {
    const std::string partial = writing.path + ".partial";
    Result<FileDescriptor> file = take_file(partial);
    if (!file) return std::move(file).error();
    Writer writer(contents, writing, partial);
    Result<void> done = writer.write(*file);
    if (done) done = check_written(file->get(), partial, executor);
    if (done && std::rename(partial.c_str(), writing.path.c_str()) != 0)
        done = system_error(writing.path, "renamed to");
    if (!done) {
        // It is locked: nobody else's.
        (void)::unlink(partial.c_str());
        return done.error();
    }
    if (done = sync_folder_of(writing.path); !done) return done.error();
    return writer.total();
}

}  // namespace haarmony::server
