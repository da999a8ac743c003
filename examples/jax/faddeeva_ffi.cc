// The handler that XLA calls: a function of the library at all numbers of a buffer.
#include "xla/ffi/api/ffi.h"

#include <complex>
#include <cstdint>
#include <mechaudit.h>

namespace ffi = xla::ffi;

static ffi::Error apply(std::int32_t function, ffi::Buffer<ffi::C128> z, ffi::ResultBuffer<ffi::C128> w) {
    mechaudit_error error;
    const auto *from = reinterpret_cast<const double *>(z.typed_data());
    auto *to = reinterpret_cast<double *>(w->typed_data());
    if (mechaudit_batch(function, z.element_count(), from, 1, to, 1, &error) != MECHAUDIT_STATUS_OK) {
        return ffi::Error::InvalidArgument(error.message);
    }
    return ffi::Error::Success();
}

XLA_FFI_DEFINE_HANDLER_SYMBOL(MechauditBatch, apply,
                              ffi::Ffi::Bind()
                                  .Attr<std::int32_t>("function")
                                  .Arg<ffi::Buffer<ffi::C128>>()
                                  .Ret<ffi::Buffer<ffi::C128>>());
