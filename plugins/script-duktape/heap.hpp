// One Duktape heap with JET's script API in it.
#pragma once

#include <duktape.h>

namespace jet::duktape {

class Play;

class Heap {
public:
    /// `play` must outlive it. Throws Failure when the memory limit is too small even for the API.
    explicit Heap(Play& play);
    ~Heap();
    Heap(const Heap&) = delete;
    Heap& operator=(const Heap&) = delete;

    duk_context* context() const { return ctx_; }

private:
    duk_context* ctx_;
};

}  // namespace jet::duktape
