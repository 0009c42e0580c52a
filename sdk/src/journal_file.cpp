#include "journal_file.hpp"

#include "hasher.hpp"
#include "system_error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace jet {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMagic = "JETJRNL1";
constexpr std::size_t kHeadSize = 4 + 1 + 8;  // length, kind, checksum
constexpr std::size_t kPeekSize = 32;         // of a record's content, where only its kind matters

std::uint64_t checksum(RecordKind kind, std::uint64_t number, std::string_view content)
{
    Hasher h;
    h.add(static_cast<std::uint64_t>(kind)), h.add(number), h.add(content);
    return h.value();
}

std::string headOf(RecordKind kind, std::uint64_t number, std::string_view content)
{
    ByteWriter out;
    for (int i = 0; i < 4; ++i) out.byte(static_cast<std::uint8_t>(content.size() >> (8 * i)));
    out.byte(static_cast<std::uint8_t>(kind));
    out.bits(checksum(kind, number, content));
    return out.take();
}

bool writeAll(int fd, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t n = ::write(fd, content.data(), content.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        content.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

bool readAll(int fd, std::uint64_t at, std::string& into)
{
    std::size_t done = 0;
    while (done < into.size()) {
        const ssize_t n = ::pread(fd, into.data() + done, into.size() - done, static_cast<off_t>(at + done));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        done += static_cast<std::size_t>(n);
    }
    return true;
}

}  // namespace

std::int64_t millisecondsNow()
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

// --- what the records hold

std::string HeadRecord::encode() const
{
    ByteWriter out;
    out.text(project), out.text(name);
    out.bits(static_cast<std::uint64_t>(time)), out.number(process), out.bits(projectHash);
    return out.take();
}

HeadRecord HeadRecord::decode(std::string_view bytes)
{
    ByteReader in(bytes);
    HeadRecord head;
    head.project = std::string(in.text()), head.name = in.storable();
    head.time = static_cast<std::int64_t>(in.bits()), head.process = in.number(), head.projectHash = in.bits();
    return head;
}

std::string BaseRecord::encode() const
{
    ByteWriter out;
    out.number(scene), out.text(file), out.bits(fileHash), out.text(text);
    return out.take();
}

BaseRecord BaseRecord::decode(std::string_view bytes)
{
    ByteReader in(bytes);
    BaseRecord base;
    base.scene = in.number(), base.file = std::string(in.text()), base.fileHash = in.bits();
    base.text = std::string(in.text());
    return base;
}

std::string SaveRecord::encode() const
{
    ByteWriter out;
    out.number(files.size());
    for (const auto& [scene, hash] : files) out.number(scene), out.bits(hash);
    return out.take();
}

SaveRecord SaveRecord::decode(std::string_view bytes)
{
    ByteReader in(bytes);
    SaveRecord save;
    for (std::size_t n = in.count(9); n > 0; --n) {
        const SceneKey scene = in.number();
        save.files.emplace_back(scene, in.bits());
    }
    return save;
}

std::string ChangesRecord::encode() const
{
    ByteWriter out;
    out.bits(static_cast<std::uint64_t>(time)), out.number(scene), out.number(count), out.text(changes);
    return out.take();
}

ChangesRecord ChangesRecord::decode(std::string_view bytes)
{
    ByteReader in(bytes);
    ChangesRecord record;
    record.time = static_cast<std::int64_t>(in.bits()), record.scene = in.number(), record.count = in.number();
    record.changes = std::string(in.text());
    return record;
}

namespace {

void encodeFilter(ByteWriter& out, const StructureRecord::FilterEntry& filter)
{
    out.text(filter.name);
    out.number(filter.scenes.size());
    for (const auto& scene : filter.scenes) out.number(scene.key), out.text(scene.name), out.text(scene.file);
    out.number(filter.filters.size());
    for (const auto& inner : filter.filters) encodeFilter(out, inner);
}

StructureRecord::FilterEntry decodeFilter(ByteReader& in, int depth)
{
    if (depth > 100) ByteReader::fail("filters are nested too deep in it");
    StructureRecord::FilterEntry filter;
    filter.name = in.storable();
    for (std::size_t n = in.count(3); n > 0; --n) {
        StructureRecord::SceneEntry scene;
        scene.key = in.number(), scene.name = in.storable(), scene.file = std::string(in.text());
        filter.scenes.push_back(std::move(scene));
    }
    for (std::size_t n = in.count(3); n > 0; --n) filter.filters.push_back(decodeFilter(in, depth + 1));
    return filter;
}

}  // namespace

std::string StructureRecord::encode() const
{
    ByteWriter out;
    out.bits(static_cast<std::uint64_t>(time)), out.text(name);
    encodeFilter(out, root);
    out.text(start);
    return out.take();
}

StructureRecord StructureRecord::decode(std::string_view bytes)
{
    ByteReader in(bytes);
    StructureRecord structure;
    structure.time = static_cast<std::int64_t>(in.bits()), structure.name = in.storable();
    structure.root = decodeFilter(in, 0);
    if (!in.atEnd()) structure.start = in.storable();
    return structure;
}

// --- writing

JournalWriter::~JournalWriter() { close(); }

void JournalWriter::close()
{
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

fs::path JournalWriter::temporary() const { return file_.string() + ".part"; }

Result<void> JournalWriter::create(const fs::path& file)
{
    close();
    file_ = file, number_ = 0, size_ = 0, published_ = false, broken_ = false;
    std::error_code problem;
    fs::create_directories(file.parent_path(), problem);
    if (problem) return systemError(file, "cannot be written", problem.value());
    fd_ = ::open(temporary().c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (fd_ < 0) return systemError(file, "cannot be written", errno);
    ::flock(fd_, LOCK_EX | LOCK_NB);  // says that we live; where locks are not known, journals are never "in use"
    if (!writeAll(fd_, kMagic)) {
        const int code = errno;
        remove();
        return systemError(file, "cannot be written", code);
    }
    size_ = kMagic.size();
    return {};
}

Result<void> JournalWriter::append(RecordKind kind, std::string_view content)
{
    if (fd_ < 0 || broken_) return systemError(file_, "cannot be written", EBADF);
    if (content.size() > 0xfffffff0U) return systemError(file_, "cannot be written", EFBIG);
    std::string record = headOf(kind, number_, content);
    record += content;
    if (writeAll(fd_, record)) {
        ++number_;
        size_ += record.size();
        return {};
    }
    const int code = errno;
    // What was written of it would hide all that comes after.
    if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0 || ::lseek(fd_, static_cast<off_t>(size_), SEEK_SET) < 0)
        broken_ = true;
    return systemError(file_, "cannot be written", code);
}

Result<void> JournalWriter::sync()
{
    if (fd_ >= 0 && ::fdatasync(fd_) != 0) return systemError(file_, "cannot be written", errno);
    return {};
}

Result<void> JournalWriter::publish(bool synced)
{
    if (synced)
        if (const auto done = sync(); !done) return done;
    if (::rename(temporary().c_str(), file_.c_str()) != 0) return systemError(file_, "cannot be written", errno);
    published_ = true;
    return synced ? syncFolder(file_.parent_path()) : Result<void>();
}

void JournalWriter::remove()
{
    if (fd_ < 0) return;
    ::unlink(published_ ? file_.c_str() : temporary().c_str());
    close();
}

// --- reading

JournalReader::~JournalReader()
{
    if (fd_ >= 0) ::close(fd_);
}

Result<void> JournalReader::open(const fs::path& file)
{
    fd_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd_ < 0) return systemError(file, "cannot be opened", errno);
    struct stat info {};
    if (::fstat(fd_, &info) != 0) return systemError(file, "cannot be read", errno);
    size_ = static_cast<std::uint64_t>(info.st_size);
    std::string magic(kMagic.size(), '\0');
    if (!readAll(fd_, 0, magic) || magic != kMagic)
        return Error("this is no journal of this version of JET; open it with the JET that wrote it",
                     Location{file.string(), 0, 0});
    at_ = magic.size();
    inUse_ = ::flock(fd_, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!inUse_) ::flock(fd_, LOCK_UN);
    return {};
}

std::optional<Record> JournalReader::next(bool withContent)
{
    if (torn_ || at_ >= size_) return std::nullopt;
    torn_ = true;
    std::string head(kHeadSize, '\0');
    if (size_ - at_ < kHeadSize || !readAll(fd_, at_, head)) return std::nullopt;
    std::uint32_t length = 0;
    for (int i = 0; i < 4; ++i)
        length |= static_cast<std::uint32_t>(static_cast<unsigned char>(head[static_cast<std::size_t>(i)])) << (8 * i);
    const auto kind = static_cast<RecordKind>(head[4]);
    if (length > size_ - at_ - kHeadSize) return std::nullopt;
    Record record{kind, std::string(withContent ? length : std::min<std::size_t>(length, kPeekSize), '\0')};
    if (!readAll(fd_, at_ + kHeadSize, record.content)) return std::nullopt;
    if (withContent && head != headOf(kind, number_, record.content)) return std::nullopt;
    torn_ = false;
    at_ += kHeadSize + length;
    ++number_;
    return record;
}

}  // namespace jet
