! The slider-crank in Fortran, to be audited:
!
!     gfortran -O2 -o slider_crank examples/candidates/slider_crank.f90
!     mechaudit audit slider-crank --exec ./slider_crank --decimal
!
! Input: crank a, rod b, offset e, guide's angle delta, phi1, assembly (1 or -1). Fortran reads no
! hexadecimal floats, hence --decimal; 17 digits give every number back.
!
! The slider's place along the guide is a cos(psi) + s c with psi = phi1 - delta, the rod's component
! across the guide h = e - a sin(psi) and along it c = sqrt(b^2 - h^2); the rest is differentiation.
program slider_crank
   use, intrinsic :: iso_fortran_env, only: real64
   implicit none
   integer, parameter :: dp = real64
   real(dp), parameter :: pi = 4*atan(1.0_dp)
   character(len=4096) :: line
   real(dp) :: a, b, e, delta, phi, assembly, psi, h, h1, h2, c, c1, c2, theta, theta1, theta2
   integer :: status

   print '(a)', '# name: slider-crank in Fortran', '# version: 1.0'
   do
      read (*, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == '#') cycle
      read (line, *, iostat=status) a, b, e, delta, phi, assembly
      if (status /= 0) then
         print '(a)', 'refuse bad layout'
         cycle
      end if
      psi = phi - delta
      h = e - a*sin(psi)
      if (.not. abs(h) < b) then
         print '(a)', 'refuse'
         cycle
      end if
      h1 = -a*cos(psi)
      h2 = a*sin(psi)
      c = sign(sqrt((b - h)*(b + h)), assembly)
      c1 = -h*h1/c
      c2 = -(h1*h1 + h*h2 + c1*c1)/c
      theta1 = h1/c
      theta2 = (h2*c - h1*c1)/c**2
      ! Seen from the guide the rod's angle is asin(h/b), mirrored at pi for the slider behind.
      theta = atan2(h, abs(c))
      if (assembly < 0) theta = pi - theta
      theta = delta + theta
      print '(6(es24.16e3, ","), es24.16e3)', &
         a*cos(psi) + c, -a*sin(psi) + c1, -a*cos(psi) + c2, &
         theta, theta1, theta2, acos(abs(h)/b)
   end do
end program slider_crank
