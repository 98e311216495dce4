// Thread sanitizer knows what happens before what from the atomics and locks of code compiled with it. TBB's shared
// library is not, so that every task handed from one thread to another would look like a race. This file stands between
// the program and that library and tells the sanitizer of the handovers: a task is spawned before it runs, the tasks of
// a wait context run before a wait for it returns, a function runs in an arena between the call and its return, and
// memory for tasks is given back before it is taken again. With these, loops over TBB are checked like any other code,
// and nothing needs to be suppressed.
//
// Linked into the tests where they are built with -fsanitize=thread. It rests on names that oneTBB keeps stable from
// release to release (its binary interface).

#include <cstddef>
#include <cstdint>
#include <dlfcn.h>
#include <oneapi/tbb/detail/_small_object_pool.h>
#include <oneapi/tbb/detail/_task.h>
#include <oneapi/tbb/task_arena.h>
#include <sanitizer/tsan_interface.h>

namespace tbb::detail {

namespace {

/// The library's own definition of the function with this mangled name.
template <class Function>
Function* original(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Stands for a task in TBB's queues.
class Handover final : public d1::task {
public:
    static d1::task& of(d1::task& spawned)
    {
        auto* handover = new Handover(spawned);
        __tsan_release(handover);
        return *handover;
    }

private:
    explicit Handover(d1::task& spawned) : spawned_(spawned) {}

    d1::task* execute(d1::execution_data& data) override { return receive().execute(data); }
    d1::task* cancel(d1::execution_data& data) override { return receive().cancel(data); }

    d1::task& receive()
    {
        __tsan_acquire(this);
        d1::task& spawned = spawned_;
        delete this;
        return spawned;
    }

    d1::task& spawned_;
};

/// Stands for a function that runs in an arena, at times on a thread that has a place in it rather than the caller's.
class HandedOver final : public d1::delegate_base {
public:
    explicit HandedOver(d1::delegate_base& function) : function_(function) { __tsan_release(&called_); }

    bool operator()() const override
    {
        __tsan_acquire(&called_);
        const bool result = function_();
        __tsan_release(&returned_);
        return result;
    }

    void acquire_result() { __tsan_acquire(&returned_); }

private:
    d1::delegate_base& function_;
    // The sanitizer tells handovers from one another by addresses alone, eight bytes apart.
    mutable std::uint64_t called_ = 0;
    mutable std::uint64_t returned_ = 0;
};

/// Tasks count themselves off in code that is compiled with the program, by an atomic in the second word.
void acquire_finished_tasks(d1::wait_context& context)
{
    static_assert(sizeof(d1::wait_context) == 16);
    __tsan_acquire(reinterpret_cast<char*>(&context) + 8);
}

void* acquired(void* memory)
{
    __tsan_acquire(memory);
    return memory;
}

} // namespace

namespace r1 {

void spawn(d1::task& task, d1::task_group_context& context)
{
    static const auto real = original<void(d1::task&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
    real(Handover::of(task), context);
}

void spawn(d1::task& task, d1::task_group_context& context, d1::slot_id slot)
{
    static const auto real = original<void(d1::task&, d1::task_group_context&, d1::slot_id)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
    real(Handover::of(task), context, slot);
}

void execute_and_wait(d1::task& task, d1::task_group_context& task_context, d1::wait_context& wait_context,
                      d1::task_group_context& waiting_context)
{
    static const auto real =
        original<void(d1::task&, d1::task_group_context&, d1::wait_context&, d1::task_group_context&)>(
            "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
    real(task, task_context, wait_context, waiting_context);
    acquire_finished_tasks(wait_context);
}

void wait(d1::wait_context& wait_context, d1::task_group_context& context)
{
    static const auto real = original<void(d1::wait_context&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
    real(wait_context, context);
    acquire_finished_tasks(wait_context);
}

void execute(d1::task_arena_base& arena, d1::delegate_base& function)
{
    static const auto real = original<void(d1::task_arena_base&, d1::delegate_base&)>(
        "_ZN3tbb6detail2r17executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE");
    HandedOver handed_over(function);
    real(arena, handed_over);
    handed_over.acquire_result();
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes)
{
    static const auto real = original<void*(d1::small_object_pool*&, std::size_t)>(
        "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm");
    return acquired(real(pool, bytes));
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data& data)
{
    static const auto real = original<void*(d1::small_object_pool*&, std::size_t, const d1::execution_data&)>(
        "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE");
    return acquired(real(pool, bytes, data));
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes)
{
    static const auto real = original<void(d1::small_object_pool&, void*, std::size_t)>(
        "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvm");
    __tsan_release(memory);
    real(pool, memory, bytes);
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes, const d1::execution_data& data)
{
    static const auto real = original<void(d1::small_object_pool&, void*, std::size_t, const d1::execution_data&)>(
        "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE");
    __tsan_release(memory);
    real(pool, memory, bytes, data);
}

} // namespace r1

} // namespace tbb::detail
