"Tridiagonal systems: the code that is audited in `test/runtests.jl`."
module Sweep

export sweep

"The solution by elimination without pivoting; `nothing` where a pivot vanishes."
function sweep(lower, diagonal, upper, d)
    pivots, x = copy(diagonal), copy(d)
    for i in eachindex(x)
        if i > 1
            factor = lower[i-1] / pivots[i-1]
            pivots[i] -= factor * upper[i-1]
            x[i] -= factor * x[i-1]
        end
        iszero(pivots[i]) && return nothing
    end
    for i in reverse(eachindex(x))
        i < length(x) && (x[i] -= upper[i] * x[i+1])
        x[i] /= pivots[i]
    end
    x
end

end
