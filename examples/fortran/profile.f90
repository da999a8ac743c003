! The Voigt profile of a line, W at many points, a spline, and what a mistake is answered.
!
!     gfortran mechaudit.f90 profile.f90 $(pkg-config --libs mechaudit) -o profile
!
! with mechaudit.f90 from capi/fortran.
program profile
    use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, c_intptr_t, c_ptr, c_size_t
    use mechaudit
    implicit none
    integer, parameter :: dp = c_double
    real(dp), parameter :: sigma = 0.5_dp, gamma = 0.25_dp
    complex(c_double_complex) :: z(1000), w(1000)
    real(dp) :: x(4) = [0, 1, 2, 4], y(4) = [0, 1, 8, 64], at(1) = 3, value(1)
    type(c_ptr) :: spline
    type(mechaudit_error) :: error
    integer :: k

    print '(a, f19.16)', 'half width ', voigt_hwhm(sigma, gamma)
    print '(a, f19.16)', 'V(0)       ', voigt(0.0_dp, sigma, gamma)

    z = [(cmplx(0.01_dp*k, -0.5_dp, dp), k=0, 999)]
    if (mechaudit_batch(function_faddeeva, 1000_c_size_t, z, 1_c_intptr_t, w, 1_c_intptr_t) /= mechaudit_ok) error stop 'batch'
    if (any(w /= [(faddeeva(z(k)), k=1, 1000)])) error stop 'a batch has other values'
    print '(a, 2f20.16)', 'w(9.99 - i/2)', w(1000)

    if (mechaudit_spline_fit(4_c_size_t, x, y, end_second_derivative, 0.0_dp, end_second_derivative, 24.0_dp, &
            outside_refuse, spline) /= mechaudit_ok) error stop 'fit'
    if (mechaudit_spline_values(spline, 1_c_size_t, at, 1_c_intptr_t, value, 1_c_intptr_t) /= mechaudit_ok) error stop 'values'
    print '(a, f19.15)', 'S(3)       ', value
    at = 5
    if (mechaudit_spline_values(spline, 1_c_size_t, at, 1_c_intptr_t, value, 1_c_intptr_t, error) == mechaudit_outside) &
        print '(2a)', 'refused: ', error_message(error)
    call mechaudit_spline_free(spline)
end program
