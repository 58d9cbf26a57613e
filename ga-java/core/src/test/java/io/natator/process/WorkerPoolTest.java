package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.concurrent.BrokenBarrierException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class WorkerPoolTest {

    private static List<SimulationRequest> requests(int count) {
        return LongStream.range(0, count).mapToObj(id -> FakeSimulator.request(id, "any")).toList();
    }

    @Test
    void resultsComeInTheOrderOfTheRequests() throws InterruptedException {
        CountDownLatch others = new CountDownLatch(10);
        FakePool.Simulation slowFirst = request -> {
            if (request.id() == 0) {
                others.await();
            }
            others.countDown();
            return SimulationResult.failed(request.id(), "");
        };
        try (Evaluator pool = new FakePool(slowFirst, 4)) {
            assertThat(pool.evaluate(requests(50))).extracting(SimulationResult::id)
                    .containsExactlyElementsOf(LongStream.range(0, 50).boxed().toList());
        }
    }

    /** Three evaluations wait for each other, which only ends if all three run at once. */
    @Test
    void workersWorkAtTheSameTime() throws InterruptedException {
        CyclicBarrier barrier = new CyclicBarrier(3);
        FakePool.Simulation meeting = request -> {
            try {
                barrier.await();
            } catch (BrokenBarrierException e) {
                throw new IllegalStateException(e);
            }
            return SimulationResult.failed(request.id(), "");
        };
        try (Evaluator pool = new FakePool(meeting, 3)) {
            assertThat(pool.evaluate(requests(9))).hasSize(9);
        }
    }

    @Test
    void aRejectedRequestEndsTheBatch() {
        FakePool.Simulation rejecting = request -> {
            throw new RequestRejectedException("unknown scene", true);
        };
        try (Evaluator pool = new FakePool(rejecting, 2)) {
            assertThatThrownBy(() -> pool.evaluate(requests(5)))
                    .isInstanceOf(RequestRejectedException.class).hasMessage("unknown scene");
        }
    }

    /** As memory, or a class that cannot be read for want of open files. */
    @Test
    void whatJavaLacksIsToldAsItIs() {
        FakePool.Simulation lacking = request -> {
            throw new NoClassDefFoundError("io/natator/Part");
        };
        try (Evaluator pool = new FakePool(lacking, 2)) {
            assertThatThrownBy(() -> pool.evaluate(requests(5))).isInstanceOf(NoClassDefFoundError.class);
        }
    }
}
