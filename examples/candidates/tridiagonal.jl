# Tridiagonal systems by Julia's own solver, to be audited:
#
#     mechaudit audit tridiagonal --exec 'julia --startup-file=no examples/candidates/tridiagonal.jl'
#
# Input: lower[n-1], diagonal[n], upper[n-1], d[n] on one line, separated by commas. Julia reads and
# writes hexadecimal floats. Its solver exchanges rows, which the budget does not ask for.
using LinearAlgebra, Printf

println("# name: LinearAlgebra.Tridiagonal\n# version: ", VERSION)
for line in eachline()
    startswith(line, '#') && continue
    v = parse.(Float64, split(line, ','))
    n = (length(v) + 2) ÷ 4
    if n < 1 || length(v) != 4n - 2
        println("refuse bad layout")
        continue
    end
    lower, diagonal = v[1:n-1], v[n:2n-1]
    upper, d = v[2n:3n-2], v[3n-1:4n-2]
    try
        x = n == 1 ? d ./ diagonal : Tridiagonal(lower, diagonal, upper) \ d
        all(isfinite, x) || throw(SingularException(n))
        println(join((@sprintf("%a", xi) for xi in x), ','))
    catch e
        e isa SingularException || rethrow()
        println("refuse singular")
    end
end
