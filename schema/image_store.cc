#include "schema/image_store.h"

#include <cassert>
#include <utility>

#include "schema/image_statements.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// True while it lives.
class Flag {
  public:
    explicit Flag(bool& flag) : flag_(flag) { flag_ = true; }
    Flag(const Flag&) = delete;
    Flag& operator=(const Flag&) = delete;
    ~Flag() { flag_ = false; }

  private:
    bool& flag_;
};

}  // namespace

ImageStore::ImageStore(Database& database)
    : statements_(std::make_unique<Statements>(database.handle())) {}

ImageStore::~ImageStore() = default;

Result<void> ImageStore::transaction(const std::function<Result<void>()>& work) {
    assert(!statements_->in_transaction);
    Result<WriteScope> scope =
        WriteScope::begin(statements_->cache, WriteScope::Kind::kTransaction);
    if (!scope)
        return while_doing("cannot begin a transaction", std::move(scope).error());
    const Flag inside(statements_->in_transaction);
    Result<void> done = work();
    if (!done) return done;
    done = scope->commit();
    if (!done) return while_doing("cannot commit", std::move(done).error());
    return {};
}

}  // namespace haarmony::schema
