# sweep() against certified references, with mechaudit on the path.
using Test

candidate = joinpath(@__DIR__, "candidate.jl")
julia = joinpath(Sys.BINDIR, "julia")
audit(command, cases) = `mechaudit audit tridiagonal --cases $cases --exec $command`

@testset "accuracy" begin
    @test success(pipeline(audit("$julia --startup-file=no $candidate", 50); stdout, stderr))
    # An audit that cannot fail would be worth nothing.
    @test !success(pipeline(audit("false", 5); stdout=devnull, stderr=devnull))
end
