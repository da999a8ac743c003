# The C interface from Julia, without a package: `ccall` as it is.
#
#     LD_LIBRARY_PATH=/usr/local/lib julia mechaudit.jl

module Mechaudit

const lib = get(ENV, "LIBMECHAUDIT", "libmechaudit")

# mechaudit_error: status, index, value, message
struct Failure
    status::Cint
    index::Csize_t
    value::Cdouble
    message::NTuple{160,UInt8}
end

function check(status, failure)
    status == 0 && return nothing
    text = String(collect(Iterators.takewhile(!iszero, failure[].message)))
    error(text)
end

# `double _Complex` by value: Julia passes ComplexF64 as C's type.
faddeeva(z::ComplexF64) = ccall((:mechaudit_faddeeva_c, lib), ComplexF64, (ComplexF64,), z)
faddeeva_derivative(z::ComplexF64) = ccall((:mechaudit_faddeeva_derivative_c, lib), ComplexF64, (ComplexF64,), z)
voigt(x, σ, γ) = ccall((:mechaudit_voigt, lib), Cdouble, (Cdouble, Cdouble, Cdouble), x, σ, γ)
voigt_hwhm(σ, γ) = ccall((:mechaudit_voigt_hwhm, lib), Cdouble, (Cdouble, Cdouble), σ, γ)

# mechaudit_function
@enum Func FADDEEVA FADDEEVA_DERIVATIVE ERF ERFC ERFCX ERFI DAWSON

"f of all z, several times as fast as one at a time; strides as the array has them."
function batch!(w::StridedVector{ComplexF64}, f::Func, z::StridedVector{ComplexF64})
    length(w) == length(z) || throw(DimensionMismatch("$(length(z)) points, room for $(length(w))"))
    failure = Ref{Failure}()
    GC.@preserve w z begin
        status = ccall(
            (:mechaudit_batch, lib), Cint,
            (Cint, Csize_t, Ptr{ComplexF64}, Cptrdiff_t, Ptr{ComplexF64}, Cptrdiff_t, Ref{Failure}),
            Integer(f), length(z), pointer(z), stride(z, 1), pointer(w), stride(w, 1), failure)
    end
    check(status, failure)
    return w
end

"The interpolating cubic spline, natural at both ends."
mutable struct Spline
    handle::Ptr{Cvoid}
    function Spline(x::Vector{Float64}, y::Vector{Float64})
        length(x) == length(y) || throw(DimensionMismatch("$(length(x)) knots, $(length(y)) ordinates"))
        handle, failure = Ref{Ptr{Cvoid}}(C_NULL), Ref{Failure}()
        status = ccall(
            (:mechaudit_spline_fit, lib), Cint,
            (Csize_t, Ptr{Cdouble}, Ptr{Cdouble}, Cint, Cdouble, Cint, Cdouble, Cint, Ref{Ptr{Cvoid}}, Ref{Failure}),
            length(x), x, y, 0, 0.0, 0, 0.0, 0, handle, failure)
        check(status, failure)
        s = new(handle[])
        return finalizer(s -> ccall((:mechaudit_spline_free, lib), Cvoid, (Ptr{Cvoid},), s.handle), s)
    end
end

function (s::Spline)(x::Real)
    value, failure = Ref{Cdouble}(), Ref{Failure}()
    status = GC.@preserve s ccall(
        (:mechaudit_spline_value, lib), Cint, (Ptr{Cvoid}, Cdouble, Ref{Cdouble}, Ref{Failure}),
        s.handle, x, value, failure)
    check(status, failure)
    return value[]
end

end # module

using .Mechaudit
using Test

@testset "mechaudit" begin
    w = Mechaudit.faddeeva(1.0 + 1.0im)
    @test w ≈ 0.3047442052569126 + 0.2082189382028316im rtol = 1e-15
    @test Mechaudit.faddeeva_derivative(1.0 + 1.0im) ≈ -2 * (1 + im) * w + 2im / sqrt(π) rtol = 1e-14
    h = Mechaudit.voigt_hwhm(0.5, 0.25)
    @test Mechaudit.voigt(h, 0.5, 0.25) ≈ Mechaudit.voigt(0, 0.5, 0.25) / 2 rtol = 1e-15
    z = [complex(0.01k, -0.5) for k in 0:999]
    @test Mechaudit.batch!(similar(z), Mechaudit.FADDEEVA, z) == Mechaudit.faddeeva.(z)
    @test Mechaudit.batch!(zeros(ComplexF64, 500), Mechaudit.FADDEEVA, view(z, 1:2:1000)) == Mechaudit.faddeeva.(z[1:2:1000])
    s = Mechaudit.Spline([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    @test s(1.0) == 1 && s(0.5) ≈ 0.6875
    @test_throws ErrorException s(3.0)
end
