# Lets mechaudit audit sweep(): one input a line, one answer a line.
using Printf
include(joinpath(@__DIR__, "..", "src", "Sweep.jl"))
using .Sweep

println("# name: Sweep.jl\n# version: 0.1.0")
for line in eachline()
    startswith(line, '#') && continue
    v = parse.(Float64, split(line, ','))
    n = (length(v) + 2) ÷ 4
    if n < 1 || length(v) != 4n - 2
        println("refuse bad layout")
        continue
    end
    x = sweep(v[1:n-1], v[n:2n-1], v[2n:3n-2], v[3n-1:4n-2])
    println(x === nothing ? "refuse singular" : join((@sprintf("%a", xi) for xi in x), ','))
end
