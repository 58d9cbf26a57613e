package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;

class BatchQueueTest {

    private static List<Long> ids(BatchQueue.Batch batch) {
        return batch.jobs().stream().map(job -> job.request().id()).toList();
    }

    /** Evaluations that take alike long stand together, such as a gait's from its two starts. */
    @Test
    void evaluationsAreDealtOutInTurn() throws InterruptedException {
        BatchQueue queue = new BatchQueue();
        List<BatchQueue.Worker> workers = List.of(queue.join(), queue.join(), queue.join());
        BatchJob.Call call = new BatchJob.Call();
        queue.add(LongStream.range(0, 8)
                .mapToObj(id -> new BatchJob(FakeSimulator.request(id, "thesis/creature-1"), call)).toList());

        assertThat(ids(queue.take(workers.get(0)))).containsExactly(0L, 3L, 6L);
        assertThat(ids(queue.take(workers.get(1)))).containsExactly(1L, 4L, 7L);
        assertThat(ids(queue.take(workers.get(2)))).containsExactly(2L, 5L);
    }
}
