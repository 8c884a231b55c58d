#include "server/app/idle_cores.h"

#include <cassert>

namespace haarmony::server {

IdleCores::IdleCores(int cores) : cores_(cores), threads_(cores - 1) {
    assert(cores >= 1);
}

IdleCores::Share::Share(IdleCores& cores) : cores_(cores) {
    const int running = ++cores_.running_;
    // At least two cores for each search, or sharing gains nothing.
    if (running * 2 <= cores_.cores_) executor_ = &cores_.threads_;
}

IdleCores::Share::~Share() { --cores_.running_; }

}  // namespace haarmony::server
