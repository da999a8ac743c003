!> The C interface of mechaudit for Fortran 2003 and later: compile this file with your program.
!>
!>     gfortran mechaudit.f90 program.f90 $(pkg-config --libs mechaudit)
!>
!> Complex numbers go by value (`complex(c_double_complex), value`), arrays of them as they are stored. What
!> the functions are, their accuracy and their errors is written in mechaudit.h.
!>
!> Licence: MIT or Apache-2.0, at your option.
module mechaudit
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_double_complex, c_int, c_null_char, c_ptr, &
        c_ptrdiff_t => c_intptr_t, c_size_t
    implicit none
    private :: c_char, c_double, c_double_complex, c_int, c_null_char, c_ptr, c_ptrdiff_t, c_size_t

    !> mechaudit_status
    integer(c_int), parameter :: mechaudit_ok = 0, mechaudit_null_pointer = 1, mechaudit_size = 2, &
        mechaudit_argument = 3, mechaudit_not_finite = 4, mechaudit_order = 5, mechaudit_not_periodic = 6, &
        mechaudit_outside = 7, mechaudit_pivot = 8, mechaudit_overflow = 9, mechaudit_memory = 10, &
        mechaudit_internal = 11
    !> mechaudit_function
    integer(c_int), parameter :: function_faddeeva = 0, function_faddeeva_derivative = 1, function_erf = 2, &
        function_erfc = 3, function_erfcx = 4, function_erfi = 5, function_dawson = 6
    !> mechaudit_spline_end
    integer(c_int), parameter :: end_second_derivative = 0, end_first_derivative = 1, end_not_a_knot = 2
    !> mechaudit_spline_outside
    integer(c_int), parameter :: outside_refuse = 0, outside_polynomial = 1, outside_tangent = 2, &
        outside_hold = 3, outside_repeat = 4

    integer, parameter :: message_length = 160

    !> mechaudit_error
    type, bind(c) :: mechaudit_error
        integer(c_int) :: status
        integer(c_size_t) :: index
        real(c_double) :: value
        character(kind=c_char) :: message(message_length)
    end type

    interface
        !> w(z) = exp(-z**2) erfc(-i z)
        pure function faddeeva(z) bind(c, name="mechaudit_faddeeva_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: faddeeva
        end function
        !> w'(z)
        pure function faddeeva_derivative(z) bind(c, name="mechaudit_faddeeva_derivative_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: faddeeva_derivative
        end function
        !> erf z
        pure function complex_erf(z) bind(c, name="mechaudit_erf_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: complex_erf
        end function
        !> erfc z
        pure function complex_erfc(z) bind(c, name="mechaudit_erfc_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: complex_erfc
        end function
        !> exp(z**2) erfc z
        pure function complex_erfcx(z) bind(c, name="mechaudit_erfcx_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: complex_erfcx
        end function
        !> -i erf(i z)
        pure function complex_erfi(z) bind(c, name="mechaudit_erfi_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: complex_erfi
        end function
        !> Dawson's function of a complex number
        pure function complex_dawson(z) bind(c, name="mechaudit_dawson_c")
            import :: c_double_complex
            complex(c_double_complex), value :: z
            complex(c_double_complex) :: complex_dawson
        end function

        !> erfi x and Dawson's function of a real number (Fortran has erf, erfc and erfc_scaled itself)
        pure function erfi(x) bind(c, name="mechaudit_erfi_real")
            import :: c_double
            real(c_double), value :: x
            real(c_double) :: erfi
        end function
        pure function dawson(x) bind(c, name="mechaudit_dawson_real")
            import :: c_double
            real(c_double), value :: x
            real(c_double) :: dawson
        end function
        !> erf x, erfc x and erfcx x of a real number by this library
        pure function real_erf(x) bind(c, name="mechaudit_erf_real")
            import :: c_double
            real(c_double), value :: x
            real(c_double) :: real_erf
        end function
        pure function real_erfc(x) bind(c, name="mechaudit_erfc_real")
            import :: c_double
            real(c_double), value :: x
            real(c_double) :: real_erfc
        end function
        pure function real_erfcx(x) bind(c, name="mechaudit_erfcx_real")
            import :: c_double
            real(c_double), value :: x
            real(c_double) :: real_erfcx
        end function

        !> the Voigt profile, and half its width at half its maximum
        pure function voigt(x, sigma, gamma) bind(c, name="mechaudit_voigt")
            import :: c_double
            real(c_double), value :: x, sigma, gamma
            real(c_double) :: voigt
        end function
        pure function voigt_hwhm(sigma, gamma) bind(c, name="mechaudit_voigt_hwhm")
            import :: c_double
            real(c_double), value :: sigma, gamma
            real(c_double) :: voigt_hwhm
        end function

        !> one of function_... at n numbers; incz and incw count complex numbers
        function mechaudit_batch(which, n, z, incz, w, incw, error) bind(c) result(status)
            import :: c_double_complex, c_int, c_ptrdiff_t, c_size_t, mechaudit_error
            integer(c_int), value :: which
            integer(c_size_t), value :: n
            integer(c_ptrdiff_t), value :: incz, incw
            complex(c_double_complex), intent(in) :: z(*)
            complex(c_double_complex), intent(inout) :: w(*)
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function
        !> one of function_erf … function_dawson at n real numbers
        function mechaudit_real_batch(which, n, x, incx, y, incy, error) bind(c) result(status)
            import :: c_double, c_int, c_ptrdiff_t, c_size_t, mechaudit_error
            integer(c_int), value :: which
            integer(c_size_t), value :: n
            integer(c_ptrdiff_t), value :: incx, incy
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: y(*)
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function
        function mechaudit_voigt_batch(n, x, incx, sigma, gamma, v, incv, error) bind(c) result(status)
            import :: c_double, c_int, c_ptrdiff_t, c_size_t, mechaudit_error
            integer(c_size_t), value :: n
            integer(c_ptrdiff_t), value :: incx, incv
            real(c_double), value :: sigma, gamma
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: v(*)
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function

        function mechaudit_tridiagonal_solve(n, lower, diagonal, upper, d, x, error_estimate, error) bind(c) &
                result(status)
            import :: c_double, c_int, c_size_t, mechaudit_error
            integer(c_size_t), value :: n
            real(c_double), intent(in) :: lower(*), diagonal(*), upper(*), d(*)
            real(c_double), intent(inout) :: x(*)
            real(c_double), intent(out), optional :: error_estimate
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function

        function mechaudit_tridiagonal_solve_batch(m, n, lower, diagonal, upper, d, x, error) bind(c) result(status)
            import :: c_double, c_int, c_size_t, mechaudit_error
            integer(c_size_t), value :: m, n
            real(c_double), intent(in) :: lower(*), diagonal(*), upper(*), d(*)
            real(c_double), intent(inout) :: x(*)
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function

        function mechaudit_spline_fit(n, x, y, first_kind, first_value, last_kind, last_value, outside, spline, &
                error) bind(c) result(status)
            import :: c_double, c_int, c_ptr, c_size_t, mechaudit_error
            integer(c_size_t), value :: n
            real(c_double), intent(in) :: x(*), y(*)
            integer(c_int), value :: first_kind, last_kind, outside
            real(c_double), value :: first_value, last_value
            type(c_ptr), intent(out) :: spline
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function
        function mechaudit_spline_values(spline, n, x, incx, y, incy, error) bind(c) result(status)
            import :: c_double, c_int, c_ptr, c_ptrdiff_t, c_size_t, mechaudit_error
            type(c_ptr), value :: spline
            integer(c_size_t), value :: n
            integer(c_ptrdiff_t), value :: incx, incy
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: y(*)
            type(mechaudit_error), intent(out), optional :: error
            integer(c_int) :: status
        end function
        subroutine mechaudit_spline_free(spline) bind(c)
            import :: c_ptr
            type(c_ptr), value :: spline
        end subroutine
    end interface

contains

    !> The message of an error as Fortran holds text.
    pure function error_message(error) result(text)
        type(mechaudit_error), intent(in) :: error
        character(len=:), allocatable :: text
        integer :: k, n
        n = 0
        do while (n < message_length)
            if (error%message(n + 1) == c_null_char) exit
            n = n + 1
        end do
        allocate (character(len=n) :: text)
        do k = 1, n
            text(k:k) = error%message(k)
        end do
    end function

end module
