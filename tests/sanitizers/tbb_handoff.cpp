// What the thread sanitizer must be told about TBB, and of memory that belongs to libraries.
//
// The sanitizer sees only code compiled for it, and Debian's TBB is not: a task that one thread spawns and
// another runs looks like a race over everything the task touches. The functions here stand in front of TBB's
// own and state the order that TBB guarantees: spawning happens before running, running before the end of
// waiting. So no report about our loops has to be suppressed, and real races between their bodies are still
// found. Linked into the programs of the tsan preset only. Written for TBB 2021.8 (binary interface 12).

#include <dlfcn.h>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <new>

extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);

/// Memory of the libraries' own is ordered by atomics that the sanitizer does not see either: what a worker
/// of TBB deletes when the last one leaves an arena, and the names that OpenImageIO shares.
extern "C" const char* __tsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __tsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
    return "race:^operator delete[](void*)\ncalled_from_lib:libOpenImageIO_Util.so\n";
}

namespace tbb::detail {
namespace {

/// The function of libtbb that the one here hides.
template <class Function>
Function* behind(const char* mangled_name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, mangled_name));
}

/// Runs a task on whichever thread takes it, after everything that came before its spawning.
class SpawnedTask final : public d1::task {
public:
    explicit SpawnedTask(d1::task& inner) : inner_(inner) { __tsan_release(this); }

    d1::task* execute(d1::execution_data& data) override {
        d1::task& inner = take();
        return inner.execute(data);
    }
    d1::task* cancel(d1::execution_data& data) override {
        d1::task& inner = take();
        return inner.cancel(data);
    }

private:
    d1::task& take() {
        __tsan_acquire(this);
        d1::task& inner = inner_;
        delete this;
        return inner;
    }

    d1::task& inner_;
};

/// `task_arena::execute` may hand its function to another thread when the arena is full.
class HandedFunction final : public d1::delegate_base {
public:
    explicit HandedFunction(d1::delegate_base& inner) : inner_(inner) { __tsan_release(&turn_); }

    bool operator()() const override {
        __tsan_acquire(&turn_);
        const bool answer = inner_();
        __tsan_release(&turn_);
        return answer;
    }
    void done() const { __tsan_acquire(&turn_); }

private:
    d1::delegate_base& inner_;
    mutable std::byte turn_{};  ///< only its address matters
};

/// Whoever finishes work decrements this counter in a header, which the sanitizer sees; the waiting is in
/// libtbb.
void* counter_of(d1::wait_context& waited_for) {
    return reinterpret_cast<std::byte*>(&waited_for) + sizeof(std::uint64_t);
}

}  // namespace

namespace r1 {

void spawn(d1::task& t, d1::task_group_context& context) {
    static auto* const original = behind<void(d1::task&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
    original(*new SpawnedTask(t), context);
}

void spawn(d1::task& t, d1::task_group_context& context, d1::slot_id slot) {
    static auto* const original = behind<void(d1::task&, d1::task_group_context&, d1::slot_id)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
    original(*new SpawnedTask(t), context, slot);
}

void execute_and_wait(d1::task& t, d1::task_group_context& task_context, d1::wait_context& waited_for,
                      d1::task_group_context& wait_context) {
    static auto* const original =
        behind<void(d1::task&, d1::task_group_context&, d1::wait_context&, d1::task_group_context&)>(
            "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_"
            "contextES6_");
    original(t, task_context, waited_for, wait_context);
    __tsan_acquire(counter_of(waited_for));
}

void wait(d1::wait_context& waited_for, d1::task_group_context& context) {
    static auto* const original = behind<void(d1::wait_context&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
    original(waited_for, context);
    __tsan_acquire(counter_of(waited_for));
}

void execute(d1::task_arena_base& arena, d1::delegate_base& function) {
    static auto* const original = behind<void(d1::task_arena_base&, d1::delegate_base&)>(
        "_ZN3tbb6detail2r17executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE");
    HandedFunction handed(function);
    original(arena, handed);
    handed.done();
}

// TBB's pools pass memory between threads in ways the sanitizer cannot see; the heap's ways it can, once it
// is told that what libtbb frees on one thread was allocated before on another.

void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data&) {
    return allocate(pool, bytes);
}
void* allocate(d1::small_object_pool*& pool, std::size_t bytes) {
    static std::byte stands_for_the_pool;
    pool = reinterpret_cast<d1::small_object_pool*>(&stands_for_the_pool);
    void* const memory = ::operator new (bytes, std::align_val_t{d1::task_alignment});
    __tsan_release(memory);
    return memory;
}
void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes, const d1::execution_data&) {
    deallocate(pool, memory, bytes);
}
void deallocate(d1::small_object_pool&, void* memory, std::size_t) {
    __tsan_acquire(memory);
    ::operator delete (memory, std::align_val_t{d1::task_alignment});
}

}  // namespace r1
}  // namespace tbb::detail
